(define (domain tyreworld)
  (:requirements :adl)
  (:types hub thing)
  (:predicates (open-boot) (in-boot ?t - thing) (have ?t - thing)
               (on ?w - thing ?h - hub) (up ?h - hub) (loose ?h - hub)
               (nutless ?h - hub) (flat ?w - thing) (wheel ?w - thing))
  (:constants jack wrench pump - thing)
  (:action open
    :parameters ()
    :precondition (not (open-boot))
    :effect (open-boot))
  (:action fetch
    :parameters (?t - thing)
    :precondition (and (open-boot) (in-boot ?t))
    :effect (and (have ?t) (not (in-boot ?t))))
  (:action loosen
    :parameters (?h - hub)
    :precondition (and (have wrench) (not (up ?h)) (not (loose ?h)))
    :effect (loose ?h))
  (:action jack-up
    :parameters (?h - hub)
    :precondition (have jack)
    :effect (and (up ?h) (not (have jack))))
  (:action undo
    :parameters (?h - hub)
    :precondition (and (up ?h) (loose ?h) (have wrench))
    :effect (nutless ?h))
  (:action swap
    :parameters (?old ?new - thing ?h - hub)
    :precondition (and (nutless ?h) (on ?old ?h) (have ?new) (wheel ?new)
                       (not (flat ?new)))
    :effect (and (on ?new ?h) (not (on ?old ?h)) (have ?old)
                 (not (have ?new))))
  (:action inflate
    :parameters (?w - thing)
    :precondition (and (have pump) (flat ?w) (imply (wheel ?w) (have ?w)))
    :effect (not (flat ?w))))
