(define (problem logistics-1)
  (:domain logistics)
  (:objects bonn essen - city post1 post2 - place air1 air2 - airport
            truck1 truck2 - truck plane - airplane parcel - package)
  (:init (in-city post1 bonn) (in-city air1 bonn)
         (in-city post2 essen) (in-city air2 essen)
         (at truck1 post1) (at truck2 air2) (at plane air1) (at parcel post1))
  (:goal (at parcel post2)))
