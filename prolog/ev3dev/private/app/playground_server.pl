:- module(ev3dev_playground_server,
          [ serve/4                     % +Folder, +Address, +Port, +Open
          ]).
:- use_module(library(http/http_dispatch)).
:- use_module(library(http/http_files)).
:- use_module(library(http/thread_httpd)).
:- use_module('../processes/browser', [open_browser/3]).

/** <module> The playground, served from a folder

What `swipl ev3dev playground` does. Prolog's own server hands out files; the
robot is in the browser.
*/

%!  serve(+Folder, +Address, +Port, +Open)
%
%   Serve the files of Folder at a port of `localhost`, or of `any` address,
%   until Prolog is interrupted; port 0 is any that is free. Open is `false`,
%   or `display`: a browser is opened if there is a display.
%
%   @error socket_error(eaddrinuse, Text) if the port is in use

serve(Folder, Address, Wanted, Open) :-
    ( Wanted =:= 0 -> true ; Port = Wanted ),
    http_handler(root(.), ev3dev_playground_server:reply(Folder), [prefix]),
    (   Address == any
    ->  At = Port
    ;   At = localhost:Port
    ),
    http_server(http_dispatch, [port(At), workers(4), silent(true)]),
    format(atom(Url), 'http://localhost:~w/', [Port]),
    format("The playground is at ~w~nCtrl-C ends it.~n", [Url]),
    flush_output,
    open_browser(Open, Url, _),
    thread_get_message(ev3dev_playground_ends).

:- public reply/2.

reply(Folder, Request) :-
    (   http_reply_from_files(Folder, [], Request)
    ->  true
    ;   http_404([], Request)
    ).
