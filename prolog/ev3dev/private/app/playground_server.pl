:- module(ev3dev_playground_server,
          [ serve/4                     % +Folder, +Address, +Port, +Open
          ]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../native/native', [view_serve_/5]).
:- use_module('../processes/browser', [open_browser/3]).

/** <module> The playground, served from a folder

`swipl ev3dev playground`: the server of the view hands out files; the robot
is in the browser.
*/

%!  serve(+Folder, +Address, +Port, +Open)
%
%   Serve the files of Folder at a port of `localhost`, or of `any` address,
%   until Prolog is interrupted; port 0 is any that is free. Open is `false`,
%   or `display`: a browser is opened if there is a display.
%
%   @error permission_error(open, port, Port) if the port is in use

serve(Folder, Address, Wanted, Open) :-
    view_serve_(Address, Wanted, '', Folder, Port),
    (   integer(Port)
    ->  true
    ;   throw_error(permission_error(open, port, Wanted), _, Port)
    ),
    format(atom(Url), 'http://localhost:~w/', [Port]),
    format("The playground is at ~w~nCtrl-C ends it.~n", [Url]),
    flush_output,
    open_browser(Open, Url, _),
    thread_get_message(ev3dev_playground_ends).
