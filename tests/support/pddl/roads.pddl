; The direct road is dear; a truck that carries nothing drives for less.
(define (domain roads)
  (:requirements :strips :typing :action-costs)
  (:types place)
  (:predicates (at ?p - place) (road ?a ?b - place) (loaded) (waits ?p - place))
  (:functions (length ?a ?b - place) - number (total-cost) - number)
  (:action drive
    :parameters (?a ?b - place)
    :precondition (and (at ?a) (road ?a ?b))
    :effect (and (at ?b) (not (at ?a)) (increase (total-cost) (length ?a ?b))
                 (increase (total-cost) 1)))
  (:action load
    :parameters (?a - place)
    :precondition (and (at ?a) (waits ?a))
    :effect (and (loaded) (not (waits ?a)) (increase (total-cost) 2)))
  (:action unload
    :parameters ()
    :precondition (loaded)
    :effect (not (loaded))))
