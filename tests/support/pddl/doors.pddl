; A robot opens the doors between it and a room. Where it can come to is derived:
; doors make circles, and what is cut off is the absence of it.
(define (domain doors)
  (:requirements :adl :derived-predicates)
  (:types room key)
  (:predicates (robot ?r - room) (fits ?k - key ?a ?b - room) (open ?a ?b - room)
               (lies ?k - key ?r - room) (has ?k - key)
               (reached ?r - room) (cut-off ?r - room))
  (:derived (reached ?r - room)
    (or (robot ?r)
        (exists (?x - room) (and (reached ?x) (or (open ?x ?r) (open ?r ?x))))))
  (:derived (cut-off ?r - room) (not (reached ?r)))
  (:action go
    :parameters (?r - room)
    :precondition (and (reached ?r) (not (robot ?r)))
    :effect (and (robot ?r)
                 (forall (?x - room) (when (not (= ?x ?r)) (not (robot ?x))))))
  (:action take
    :parameters (?k - key ?r - room)
    :precondition (and (robot ?r) (lies ?k ?r))
    :effect (and (has ?k) (not (lies ?k ?r))))
  (:action unlock
    :parameters (?k - key ?a ?b - room)
    :precondition (and (has ?k) (fits ?k ?a ?b) (robot ?a) (cut-off ?b))
    :effect (open ?a ?b)))
