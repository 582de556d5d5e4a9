:- module(ev3dev_screen,
          [ screen_clear/0,
            screen_point/2,             % +X, +Y
            screen_point/3,             % +X, +Y, +Options
            screen_line/4,              % +X1, +Y1, +X2, +Y2
            screen_line/5,              % +X1, +Y1, +X2, +Y2, +Options
            screen_rectangle/4,         % +X, +Y, +Width, +Height
            screen_rectangle/5,         % +X, +Y, +Width, +Height, +Options
            screen_circle/3,            % +X, +Y, +Radius
            screen_circle/4,            % +X, +Y, +Radius, +Options
            screen_arc/5,               % +X, +Y, +Radius, +Start, +Sweep
            screen_arc/6,               % ..., +Sweep, +Options
            screen_text/3,              % +X, +Y, +Text
            screen_text/4,              % +X, +Y, +Text, +Options
            screen_image/3,             % +X, +Y, +File
            screen_show/0,
            screen_png/1                % +File
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [evaluated/2, must_be/2]).
:- use_module(private/errors/errors,
              [domain_error/2, in_own_name/1, throw_error/3]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(files, []).
:- use_module(private/checks/arguments,
              [must_be_options/3, must_be_within/4, option/3]).
:- use_module(private/files/directory, [file_path/2]).
:- use_module(private/native/native,
              [ screen_clear_/0, screen_draw_/2, screen_image_/3,
                screen_png_/1, screen_show_/0, screen_write_/4 ]).

/** <module> The screen

The screen has 178 x 128 pixels. X goes to the right from 0 and Y down from 0.
Coordinates and sizes are in pixels and may be arithmetic expressions. Pixels
outside the screen are ignored.

A program draws on a sheet of its own, and screen_show/0 shows the sheet at
once. The sheet keeps its pixels: a program that draws more and shows again
sees the old and the new. The sheet is white at first. All threads share it.

```
?- screen_clear, screen_text(10, 10, 'Hello'), screen_show.
```

Drawing works on any machine. screen_show/0 and screen_png/1 fail if there is
no screen of an EV3.

## Options {#screen-options}

  - color(+Color)
    `black` (default), `dark_gray`, `light_gray` or `white`. Versions of
    ev3dev before 2018 have only black and white, and show each gray as the
    nearer one.
  - width(+Pixels)
    The width of lines, from 1 (default) to 128.
  - fill(+Boolean)
    If `true`, rectangles and circles are filled. Default is `false`.

@error domain_error(screen_option, Option) if Option is not one of these
*/

%!  screen_clear is det.
%
%   Make all of the sheet white.

screen_clear :-
    screen_clear_.

%!  screen_point(+X, +Y) is det.
%!  screen_point(+X, +Y, +Options) is det.
%
%   Draw one pixel.
%
%   @error domain_error(pixels, X) if a coordinate or size, here and below, is
%          beyond 10000
%   @error domain_error(screen_color, Color)

screen_point(X, Y) :-
    screen_point(X, Y, []).

screen_point(X0, Y0, Options) :-
    place(X0, X),
    place(Y0, Y),
    draw(point(X, Y), Options).

%!  screen_line(+X1, +Y1, +X2, +Y2) is det.
%!  screen_line(+X1, +Y1, +X2, +Y2, +Options) is det.
%
%   Draw a line from one pixel to another.
%
%   @error domain_error(line_width, Pixels)

screen_line(X1, Y1, X2, Y2) :-
    screen_line(X1, Y1, X2, Y2, []).

screen_line(XA0, YA0, XB0, YB0, Options) :-
    place(XA0, XA),
    place(YA0, YA),
    place(XB0, XB),
    place(YB0, YB),
    draw(line(XA, YA, XB, YB), Options).

%!  screen_rectangle(+X, +Y, +Width, +Height) is det.
%!  screen_rectangle(+X, +Y, +Width, +Height, +Options) is det.
%
%   Draw a rectangle. X and Y are its upper left corner. The line lies inside
%   the rectangle.
%
%   @error domain_error(pixels, Width) if Width or Height is negative

screen_rectangle(X, Y, Width, Height) :-
    screen_rectangle(X, Y, Width, Height, []).

screen_rectangle(X0, Y0, Width0, Height0, Options) :-
    place(X0, X),
    place(Y0, Y),
    size(Width0, Width),
    size(Height0, Height),
    draw(rectangle(X, Y, Width, Height), Options).

%!  screen_circle(+X, +Y, +Radius) is det.
%!  screen_circle(+X, +Y, +Radius, +Options) is det.
%
%   Draw a circle around a pixel.
%
%   @error domain_error(pixels, Radius) if Radius is negative

screen_circle(X, Y, Radius) :-
    screen_circle(X, Y, Radius, []).

screen_circle(X0, Y0, Radius0, Options) :-
    place(X0, X),
    place(Y0, Y),
    size(Radius0, Radius),
    draw(circle(X, Y, Radius), Options).

%!  screen_arc(+X, +Y, +Radius, +Start, +Sweep) is det.
%!  screen_arc(+X, +Y, +Radius, +Start, +Sweep, +Options) is det.
%
%   Draw a piece of a circle that begins at Start and continues by Sweep. Both
%   are in degrees; 0 is up and clockwise is positive, as for turn/2.

screen_arc(X, Y, Radius, Start, Sweep) :-
    screen_arc(X, Y, Radius, Start, Sweep, []).

screen_arc(X0, Y0, Radius0, Start0, Sweep0, Options) :-
    place(X0, X),
    place(Y0, Y),
    size(Radius0, Radius),
    degrees(Start0, Start),
    degrees(Sweep0, Sweep),
    draw(arc(X, Y, Radius, Start, Sweep), Options).

draw(Shape, Options) :-
    must_be_options(screen_option, [color, width, fill], Options),
    option(color(Color), Options, black),
    option(width(Width), Options, 1),
    option(fill(Fill), Options, false),
    must_be_within(1, 128, line_width, Width),
    must_be(boolean, Fill),
    screen_draw_(Shape, style(Color, Width, Fill)).

%   The bounds keep the native code's arithmetic within its integers.

place(Expression, Pixels) :-
    evaluated(round(Expression), Pixels),
    (   integer(Pixels),
        between(-10000, 10000, Pixels)
    ->  true
    ;   domain_error(pixels, Expression)
    ).

size(Expression, Pixels) :-
    place(Expression, Pixels),
    (   Pixels >= 0
    ->  true
    ;   format(atom(Text), 'the number must be from 0 to 10000, not ~w',
               [Pixels]),
        throw_error(domain_error(pixels, Expression), _, Text)
    ).

degrees(Expression, Degrees) :-
    evaluated(Expression, Degrees),
    (   abs(Degrees) =< 10000
    ->  true
    ;   domain_error(degrees, Expression)
    ).

%!  screen_text(+X, +Y, +Text) is det.
%!  screen_text(+X, +Y, +Text, +Options) is det.
%
%   Write a text with its upper left corner at X, Y. Text is an atom, string
%   or number. A newline in it starts another line. The fonts have the letters
%   of western Europe (ISO 8859-1); other letters appear as `?`. Options:
%
%     - font(+Font)
%       `tiny` (5 x 8 pixels), `small` (6 x 10), `medium` (7 x 13, default)
%       or `large` (10 x 20).
%     - scale(+Times)
%       Enlarge the letters by this factor, from 1 (default) to 16.
%     - align(+Align)
%       `left` (default), or `center` or `right` if X is the middle or the
%       right end of the text.
%     - color(+Color)
%     - background(+Color)
%       The color behind the letters. By default the pixels behind the letters
%       stay as they are.
%
%   @error domain_error(font, Font)
%   @error domain_error(text_scale, Times)
%   @error domain_error(text_align, Align)
%   @error domain_error(screen_color, Color)
%   @error domain_error(screen_option, Option) if Option is not an option of
%          this predicate

screen_text(X, Y, Text) :-
    screen_text(X, Y, Text, []).

screen_text(X0, Y0, Text, Options) :-
    place(X0, X),
    place(Y0, Y),
    must_be(atomic, Text),
    must_be_options(screen_option, [font, scale, align, color, background],
                    Options),
    option(font(Font), Options, medium),
    option(scale(Scale), Options, 1),
    option(align(Align), Options, left),
    option(color(Color), Options, black),
    option(background(Background), Options, none),
    must_be_within(1, 16, text_scale, Scale),
    in_own_name(format(string(String), "~w", [Text])),
    screen_write_(X, Y, String,
                  letters(Color, Background, Font, Scale, Align)).

%!  screen_image(+X, +Y, +File) is det.
%
%   Draw a picture from a PNG or PBM file, with its upper left corner at X, Y.
%   Colors become grays. Pixels that are more than half transparent are left
%   out.
%
%   @error existence_error(file, File)
%   @error syntax_error(png) or syntax_error(pbm) if File is no PNG or PBM
%          file, is an interlaced PNG, or is more than 4096 pixels wide or
%          high

screen_image(X0, Y0, File) :-
    place(X0, X),
    place(Y0, Y),
    must_be(nonvar, File),
    file_path(File, Path),
    screen_image_(X, Y, Path).

%!  screen_show is semidet.
%
%   Show the sheet at once. Fails if there is no screen.
%
%   On the brick the menu owns the screen. It gives the screen to a program
%   that was started from the menu or by `brickrun`.
%
%   @error permission_error(write, attribute, File) if the user is not in the
%          group `video`

screen_show :-
    (   screen_show_
    ->  true
    ;   no_screen
    ).

no_screen :-
    fail_because(lacking(screen)).

%!  screen_png(+File) is semidet.
%
%   Write the content of the screen to a PNG file, also if another program
%   drew it. Fails if there is no screen.
%
%   @error existence_error(file, File) if the directory of File does not exist

screen_png(File) :-
    must_be(nonvar, File),
    file_path(File, Path),
    (   screen_png_(Path)
    ->  true
    ;   no_screen
    ).
