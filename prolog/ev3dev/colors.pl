:- module(ev3dev_colors,
          [ color_name/2,               % ?Number, ?Name
            col_white/1,                % ?Port
            col_rgb/2,                  % ?Port, -RGB
            col_hsv/2                   % ?Port, -HSV
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/basics/fields,
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/run/brick).
:- use_module(sensors, [col_rgb_raw/4]).

:- fields(white(brick, port, red, green, blue)).

/** <module> Colors

The EV3's color sensor distinguishes seven colors by itself, see col_color/2.
This library names them, and measures any color by a calibrated white. Loaded
apart from library(ev3dev):

```
?- use_module(library(ev3dev/colors)).
?- col_color(_, Number), color_name(Number, Name).
Number = 5,
Name = red.
?- col_white(in2).                      % on a white sheet
?- col_hsv(in2, hsv(Hue, _, _)).        % on something green
Hue = 121.
```
*/

%!  color_name(?Number, ?Name) is nondet.
%
%   True if Name is the color that col_color/2 reports as Number: 0 `none`, 1
%   `black`, 2 `blue`, 3 `green`, 4 `yellow`, 5 `red`, 6 `white`, 7 `brown`.

color_name(Number, Name) :-
    color(Number, Name),
    true.

color(0, none).
color(1, black).
color(2, blue).
color(3, green).
color(4, yellow).
color(5, red).
color(6, white).
color(7, brown).

:- dynamic white/5.                     % Brick, Port, Red, Green, Blue
:- of_brick([white/5]).

%!  col_white(?Port) is semidet.
%
%   Take what the color sensor at Port sees now as white. Fails if there is no
%   such sensor, or if it sees nothing.

col_white(Port) :-
    col_rgb_raw(Port, Red, Green, Blue),
    Red > 0,
    Green > 0,
    Blue > 0,
    !,
    brick(Brick),
    retractall(white(brick: Brick, port: Port)),
    assertz(white(Brick, Port, Red, Green, Blue)).

%!  col_rgb(?Port, -RGB) is nondet.
%
%   True if the color sensor sees RGB, a term `rgb(Red, Green, Blue)` with
%   integers from 0 to 100: percentages of the white of col_white/1. Without
%   col_white/1, the raw value of white is taken to be 400. What is brighter
%   than white is 100.

col_rgb(Port, rgb(Red, Green, Blue)) :-
    col_rgb_raw(Port, R, G, B),
    white_of(Port, WR, WG, WB),
    percent(R, WR, Red),
    percent(G, WG, Green),
    percent(B, WB, Blue).

white_of(Port, Red, Green, Blue) :-
    (   brick(Brick),
        white(Brick, Port, R, G, B)
    ->  Red = R, Green = G, Blue = B
    ;   Red = 400, Green = 400, Blue = 400
    ).

percent(Raw, White, Percent) :-
    Percent is min(100, round(100 * Raw / White)).

%!  col_hsv(?Port, -HSV) is nondet.
%
%   True if the color sensor sees HSV, a term `hsv(Hue, Saturation, Value)` of
%   integers: Hue in degrees from 0 to 359, where red is 0, green 120 and blue
%   240; Saturation in percent, 0 for gray; Value, the brightness, in percent.
%   The white is that of col_rgb/2. Hue distinguishes colors in any light; it
%   is of no use where Saturation or Value is low.

col_hsv(Port, hsv(Hue, Saturation, Value)) :-
    col_rgb(Port, rgb(R, G, B)),
    Value is max(R, max(G, B)),
    Chroma is Value - min(R, min(G, B)),
    hue(Chroma, Value, R, G, B, Hue),
    (   Value =:= 0
    ->  Saturation = 0
    ;   Saturation is round(100 * Chroma / Value)
    ).

hue(0, _R, _, _G, _B, 0) :-
    !.
hue(Chroma, R, R, G, B, Hue) :-
    !,
    Hue is round(60 * (G - B) / Chroma) mod 360.
hue(Chroma, G, R, G, B, Hue) :-
    !,
    Hue is round(120 + 60 * (B - R) / Chroma).
hue(Chroma, B, R, G, B, Hue) :-
    Hue is round(240 + 60 * (R - G) / Chroma).
