% A drawn maze: # is a wall, ^ the start and its heading. The floor at the
% exit is red. Corridors are 30 cm wide.

map(30, [ "###########",
          "#r#.......#",
          "#.#.#####.#",
          "#.#.#...#.#",
          "#.#.#.#.#.#",
          "#.#.#.#...#",
          "#.#.#.###.#",
          "#...#.#...#",
          "###.#.#.###",
          "#^..#.....#",
          "###########"
        ]).
