(define (domain visitall)
  (:requirements :typing)
  (:types place)
  (:predicates (connected ?x ?y - place) (at-robot ?x - place)
               (visited ?x - place))
  (:action move
    :parameters (?cur ?next - place)
    :precondition (and (at-robot ?cur) (connected ?cur ?next))
    :effect (and (at-robot ?next) (not (at-robot ?cur)) (visited ?next))))
