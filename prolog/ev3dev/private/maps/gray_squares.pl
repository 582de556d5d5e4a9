:- module(ev3dev_gray_squares,
          [ write_shades/4              % +File, +Side, +Bounds, +Cells
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module('../files/directory', [write_file/2]).
:- use_module('../basics/small_lists', [one_of/2]).

%!  write_shades(+File, +Side, +Bounds, +Cells) is det.
%
%   Draw squares of Side cm as SVG: Cells is a list of `cell(X, Y, Shade)`
%   with their middles, white at shade 0 and black at 1. Bounds is
%   `bounds(X1, Y1, X2, Y2)`, what is seen.

write_shades(File, Side, Bounds, Cells) :-
    write_file(File, squares(Side, Bounds, Cells)).

squares(Side, bounds(X1, Y1, X2, Y2), Cells, Stream) :-
    Width is X2-X1,
    Height is Y2-Y1,
    format(Stream, '<svg xmlns="http://www.w3.org/2000/svg" \c
                    viewBox="0 0 ~2f ~2f" width="~0f" height="~0f">~n\c
                    <rect width="100%" height="100%" fill="#ddd"/>~n',
           [Width, Height, 2*Width, 2*Height]),
    forall(one_of(Cells, cell(X, Y, Shade)),
           ( Left is X - Side/2 - X1,
             Top is Y2 - Y - Side/2,
             Gray is round(255 * (1-Shade)),
             format(Stream, '<rect x="~2f" y="~2f" width="~1f" \c
                             height="~1f" fill="rgb(~d,~d,~d)"/>~n',
                    [Left, Top, Side, Side, Gray, Gray, Gray]) )),
    format(Stream, '</svg>~n', []).
