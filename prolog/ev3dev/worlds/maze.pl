% A maze, drawn: # is a wall, ^ the start and its heading, and at the exit
% the floor is red. Corridors are 30 cm wide.

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
