:- module(pictures,
          [ picture/1,                  % ?Name
            draw/1,                     % +Name
            picture_file/3              % +Name, +Bits, -File
          ]).
:- asserta(user:file_search_path(library, prolog)).
:- use_module(library(ev3dev)).

/** <module> Pictures that are compared with files

`tests/pictures/<Name>.png` is what the screen shows after draw/1, and
`<Name>_1.png` what one with a bit for a pixel does.
*/

%!  picture(?Name) is nondet.

picture(shapes).
picture(shades).
picture(letters).
picture(edges).
picture(images).
picture(face).

%!  picture_file(+Name, +Bits, -File)

picture_file(Name, Bits, File) :-
    (   Bits == 1
    ->  Suffix = '_1.png'
    ;   Suffix = '.png'
    ),
    atomic_list_concat(['tests/pictures/', Name, Suffix], File).

%!  draw(+Name)
%
%   Draw it on a clear sheet.

draw(Name) :-
    screen_clear,
    drawing(Name).

drawing(shapes) :-
    screen_point(5, 5),
    screen_point(7, 5, [color(dark_gray)]),
    screen_line(10, 5, 60, 25),
    screen_line(10, 25, 60, 5, [width(3), color(dark_gray)]),
    screen_rectangle(70, 5, 40, 20),
    screen_rectangle(75, 10, 30, 10, [fill(true), color(light_gray)]),
    screen_rectangle(120, 5, 50, 20, [width(4)]),
    screen_circle(25, 60, 20),
    screen_circle(75, 60, 20, [fill(true)]),
    screen_circle(75, 60, 10, [fill(true), color(white)]),
    screen_circle(125, 60, 20, [width(5), color(dark_gray)]),
    screen_circle(160, 60, 0),
    screen_arc(25, 105, 18, 0, 90),
    screen_arc(75, 105, 18, 90, 180, [width(4)]),
    screen_arc(125, 105, 18, 0, -90, [width(2)]),
    screen_arc(158, 105, 15, 45, 360).
drawing(shades) :-
    shade(0, black),
    shade(1, dark_gray),
    shade(2, light_gray),
    shade(3, white),
    screen_rectangle(0, 0, 178, 128).
drawing(letters) :-
    screen_text(2, 2, 'tiny: Zahn, 0123', [font(tiny)]),
    screen_text(2, 12, "small: Grüße, señor", [font(small)]),
    screen_text(2, 24, 'medium: a\nnew line'),
    screen_text(2, 52, 'large ?!', [font(large)]),
    screen_text(177, 52, 84.3, [font(large), align(right)]),
    screen_text(89, 74, middle, [align(center), color(white), background(black)]),
    screen_text(2, 90, 'x3', [scale(3), color(dark_gray)]),
    screen_text(100, 95, '€ is no letter', [font(tiny)]).
drawing(edges) :-
    screen_circle(0, 0, 30, [fill(true)]),
    screen_circle(177, 127, 30, [fill(true), color(dark_gray)]),
    screen_line(-50, 140, 200, -20, [width(2)]),
    screen_rectangle(-10, 100, 60, 60, [fill(true), color(light_gray)]),
    screen_text(-6, 50, 'cut off', [font(large)]),
    screen_text(140, 8, 'cut off', [font(large)]),
    screen_point(1000, 1000),
    screen_rectangle(60, 60, 0, 0, [fill(true)]).
drawing(images) :-
    screen_rectangle(0, 0, 178, 64, [fill(true), color(light_gray)]),
    screen_image(10, 10, 'tests/pictures/sample.png'),
    screen_image(60, 10, 'tests/pictures/sample_p1.pbm'),
    screen_image(110, 10, 'tests/pictures/sample_p4.pbm'),
    screen_image(-8, 100, 'tests/pictures/sample.png').
drawing(face) :-
    screen_circle(89, 64, 60, [width(3)]),
    screen_circle(65, 45, 8, [fill(true)]),
    screen_circle(113, 45, 8, [fill(true)]),
    screen_arc(89, 64, 36, 100, 160, [width(4)]).

shade(Index, Color) :-
    X is 4 + 43 * Index,
    screen_rectangle(X, 4, 40, 100, [fill(true), color(Color)]),
    screen_text(X, 110, Color, [font(tiny)]).
