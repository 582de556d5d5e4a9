:- module(ev3dev_browser,
          [ open_browser/3              % +Open, +Url, -Opened
          ]).

/** <module> The browser of this machine
*/

%!  open_browser(+Open, +Url, -Opened) is det.
%
%   Open a browser at Url if Open is `true`, or if it is `display` and there
%   is a display. Opened is whether one was begun: there may be no browser.

%   The browser gets no socket of ours, and must not hold up the toplevel.
open_browser(Open, Url, Opened) :-
    (   browses(Open),
        opener(Program),
        format(atom(Command),
               '~w \'~w\' >/dev/null 2>&1 </dev/null &', [Program, Url]),
        catch(shell(Command, _), _, true)
    ->  Opened = true
    ;   Opened = false
    ).

browses(true).
browses(display) :-
    (   getenv('DISPLAY', Display)
    ;   getenv('WAYLAND_DISPLAY', Display)
    ),
    Display \== '',
    !.

opener(Program) :-
    '$member'(Program, ['xdg-open', 'sensible-browser', 'x-www-browser']),
    format(atom(Command), 'command -v ~w >/dev/null 2>&1', [Program]),
    catch(shell(Command, 0), _, fail),
    !.
