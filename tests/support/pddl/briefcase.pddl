; What is in the briefcase goes along with it.
(define (domain briefcase)
  (:requirements :strips :typing :conditional-effects
                 :universal-preconditions)
  (:types portable location)
  (:predicates (at ?o - portable ?l - location) (is-at ?l - location)
               (in ?o - portable))
  (:action move
    :parameters (?m ?l - location)
    :precondition (is-at ?m)
    :effect (and (is-at ?l) (not (is-at ?m))
                 (forall (?o - portable)
                   (when (in ?o) (and (at ?o ?l) (not (at ?o ?m)))))))
  (:action put-in
    :parameters (?o - portable ?l - location)
    :precondition (and (not (in ?o)) (at ?o ?l) (is-at ?l))
    :effect (in ?o))
  (:action take-out
    :parameters (?o - portable)
    :precondition (in ?o)
    :effect (not (in ?o))))
