(define (domain logistics)
  (:requirements :strips :typing)
  (:types package vehicle - thing
          truck airplane - vehicle
          airport - place
          city place - object)
  (:predicates (at ?t - thing ?p - place) (in ?k - package ?v - vehicle)
               (in-city ?p - place ?c - city))
  (:action load
    :parameters (?k - package ?v - vehicle ?p - place)
    :precondition (and (at ?k ?p) (at ?v ?p))
    :effect (and (not (at ?k ?p)) (in ?k ?v)))
  (:action unload
    :parameters (?k - package ?v - vehicle ?p - place)
    :precondition (and (in ?k ?v) (at ?v ?p))
    :effect (and (not (in ?k ?v)) (at ?k ?p)))
  (:action drive
    :parameters (?t - truck ?a ?b - place ?c - city)
    :precondition (and (at ?t ?a) (in-city ?a ?c) (in-city ?b ?c))
    :effect (and (not (at ?t ?a)) (at ?t ?b)))
  (:action fly
    :parameters (?f - airplane ?a ?b - airport)
    :precondition (at ?f ?a)
    :effect (and (not (at ?f ?a)) (at ?f ?b))))
