:- module(ev3dev_picture,
          [ draw_panels/5               % +File, +Map, +Start, +Goal, +Panels
          ]).
:- use_module('../private/basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(library(lists), [member/2, nth0/3]).
:- use_module(library(option), [option/3]).
:- use_module(library(pairs), [pairs_values/2]).
:- use_module('../private/files/directory', [write_file/2]).
:- use_module('../private/grid/map').

:- fields(panel(planner, facts, path, counts, most)).

/** <module> A picture of the expanded states
*/

%   Widths in pixels: a cell, the gap between panels, the line of its title.
cell(24).
gap(16).
title(36).

%!  draw_panels(+File, +Map, +Start, +Goal, +Panels) is det.
%
%   Write an SVG picture with a panel for each
%   `panel(Planner, Facts, Path, Cells)`. A panel shows the map and the path
%   of the robot. The more often a cell is in the sorted list Cells, the
%   darker blue it is, on a logarithmic scale that all panels share.

draw_panels(File, Map, Start, Goal, Panels0) :-
    findall(panel(Planner, Facts, Path, Counts, Most),
            ( member(panel(Planner, Facts, Path, Cells), Panels0),
              count(Cells, Counts),
              pairs_values(Counts, Numbers),
              largest(Numbers, 1, Most)
            ),
            Panels),
    findall(Most, member(panel(most: Most), Panels), Mosts),
    largest(Mosts, 1, Most),
    write_file(File, draw(Map, Start, Goal, Panels, Most)).

count([], []).
count([Cell|Cells], [Cell-Count|Counts]) :-
    count(Cells, Cell, 1, Count, Rest),
    count(Rest, Counts).

count([Cell|Cells], Cell, Count0, Count, Rest) :-
    !,
    Count1 is Count0 + 1,
    count(Cells, Cell, Count1, Count, Rest).
count(Rest, _, Count, Count, Rest).

largest([], Most, Most).
largest([Number|Numbers], Most0, Most) :-
    Most1 is max(Most0, Number),
    largest(Numbers, Most1, Most).

draw(Map, Start, Goal, Panels, Most, Out) :-
    size(Map, Width, Height),
    length(Panels, Count),
    Columns is max(1, min(5, Count)),
    Rows is (Count + Columns - 1) // Columns,
    gap(Gap),
    AllWidth is Columns * (Width + Gap) + Gap,
    AllHeight is Rows * (Height + Gap) + Gap,
    format(Out, "<svg xmlns=\"http://www.w3.org/2000/svg\" \c
                 viewBox=\"0 0 ~d ~d\" width=\"~d\" height=\"~d\" \c
                 font-family=\"sans-serif\">~n",
           [AllWidth, AllHeight, AllWidth, AllHeight]),
    format(Out, "<rect width=\"~d\" height=\"~d\" fill=\"#fff\"/>~n",
           [AllWidth, AllHeight]),
    forall(nth0(N, Panels, Panel),
           ( X is Gap + (N mod Columns) * (Width + Gap),
             Y is Gap + (N // Columns) * (Height + Gap),
             format(Out, "<g transform=\"translate(~d,~d)\">~n", [X, Y]),
             draw_panel(Out, Map, Start, Goal, Panel, Most),
             format(Out, "</g>~n", [])
           )),
    format(Out, "</svg>~n", []).

%   A narrow map still needs room for the title.

size(Map, Width, Height) :-
    grid_bounds(Map, X1, Y1, X2, Y2),
    cell(Cell),
    title(Title),
    Width is max(190, (X2 - X1 + 1) * Cell),
    Height is (Y2 - Y1 + 1) * Cell + Title.

draw_panel(Out, Map, Start, Goal, Panel, Most) :-
    Panel = panel(Planner, Facts, Path, Counts, _),
    option(expanded(Expanded), Facts, 0),
    option(cost(Cost), Facts, none),
    (   Cost == none
    ->  Found = 'no way'
    ;   format(atom(Found), "cost ~w", [Cost])
    ),
    format(Out, "<text y=\"12\" font-size=\"13\" font-weight=\"bold\">~w\c
                 </text>~n", [Planner]),
    format(Out, "<text y=\"28\" font-size=\"12\">~w expanded, ~w</text>~n",
           [Expanded, Found]),
    forall(grid_cell(Map, Cell),
           draw_cell(Out, Map, Cell, Counts, Most)),
    draw_path(Out, Map, Path),
    Start = state(StartCell, _),
    Goal = state(GoalCell, _),
    draw_mark(Out, Map, StartCell, '#2a2'),
    draw_mark(Out, Map, GoalCell, '#d22').

draw_cell(Out, Map, Cell, Counts, Most) :-
    middle(Map, Cell, X, Y),
    cell(Size),
    (   free_cell(Map, Cell)
    ->  (   member(Cell-Count, Counts)
        ->  shade(Count, Most, Color)
        ;   Color = '#fff'
        )
    ;   Color = '#444'
    ),
    Left is X - Size // 2,
    Top is Y - Size // 2,
    format(Out, "<rect x=\"~d\" y=\"~d\" width=\"~d\" height=\"~d\" \c
                 fill=\"~w\" stroke=\"#bbb\" stroke-width=\"0.5\"/>~n",
           [Left, Top, Size, Size, Color]).

%   From pale to deep blue.

shade(Count, Most, Color) :-
    Depth is log(1 + Count) / log(1 + Most),
    Red is round(222 - 190 * Depth),
    Green is round(238 - 130 * Depth),
    Blue is round(255 - 60 * Depth),
    format(atom(Color), "rgb(~d,~d,~d)", [Red, Green, Blue]).

draw_path(Out, Map, Path) :-
    format(Out, "<polyline fill=\"none\" stroke=\"#d80\" \c
                 stroke-width=\"3\" stroke-linejoin=\"round\" points=\"", []),
    forall(member(Cell, Path),
           ( middle(Map, Cell, X, Y), format(Out, "~0f,~0f ", [X, Y]) )),
    format(Out, "\"/>~n", []).

draw_mark(Out, Map, Cell, Color) :-
    middle(Map, Cell, X, Y),
    format(Out, "<circle cx=\"~d\" cy=\"~d\" r=\"6\" fill=\"~w\"/>~n",
           [X, Y, Color]).

middle(Map, [CX, CY], X, Y) :-
    grid_bounds(Map, X1, _, _, Y2),
    cell(Size),
    title(Title),
    X is (CX - X1) * Size + Size // 2,
    Y is Title + (Y2 - CY) * Size + Size // 2.
