:- module(ev3dev_queries,
          [ calls/2                     % +Query, -Goal
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module('../basics/small_lists', [and_list/2, one_of/2]).
:- use_module('../errors/frames', [program/1]).
:- use_module('../native/native',
              [running_/1, view_held_/0, view_pause_/1]).
:- use_module('../run/brick', [brick/1, in_brick/2, is_simulated/0]).
:- use_module('../run/waits', []).

/** <module> What is said around a query of the toplevel

Before it begins: if a file has changed that defines what it calls. When it
has failed: which goal of the program was the last one, if the program has
used the robot. When it has failed, or ended by an error or an abort: which
motors are still running. A library that knows better why a query has failed
says so by why_failed/2. While the menu of Ctrl-C waits, simulated time
stands; that of a brick does not, so this says which motors go on. A page,
another thread, or a program that ends says nothing.
*/

:- multifile
    ev3dev_waits:time_goes_on/0,
    why_failed/2,                       % Query, Message
    user:expand_query/4,
    user:message_hook/3,
    prolog:message//1.
:- dynamic
    why_failed/2,
    user:expand_query/4,
    user:message_hook/3,
    stands/1,                           % Brick, whose time stands, in a menu
    query/1,                            % the goal that runs
    said/2.                             % File, when it was changed
:- volatile
    stands/1,
    query/1,
    said/2.

:- initialization(
       asserta((user:expand_query(Query, _, _, _) :-
                    catch(ev3dev_queries:begins(Query), error(_, _), fail),
                    fail)),
       now).

begins(Query) :-
    thread_self(main),
    ignore(menu(query)),
    callable(Query),
    retractall(query(_)),
    assertz(query(Query)),
    of_libraries,
    once(program(_)),
    use_module(library(ev3dev/private/explain/last_goal), []),
    Watch = ev3dev_last_goal:watch_goals(Query),
    call(Watch),
    calls(Query, Goal),
    predicate_property(user:Goal, file(File)),
    program(File),
    changed(File),
    print_message(warning, ev3dev(changed(File))),
    fail.
begins(_).

%   list_undefined/0, which make/0 calls, looks at all modules that are not of
%   libraries, and knows nothing of a library that is loaded at its first use.

of_libraries :-
    forall(( current_module(Module),
             sub_atom(Module, 0, _, _, ev3dev),
             module_property(Module, class(user)) ),
           set_module(Module:class(library))).

%!  calls(+Query, -Goal) is nondet.
%
%   Goal is one of those that Query joins by commas.

calls(Query, Goal) :-
    callable(Query),
    (   Query = (Goal1, Goal2)
    ->  ( calls(Goal1, Goal) ; calls(Goal2, Goal) )
    ;   Goal = Query
    ).

%   Each change is reported once.

changed(File) :-
    source_file_property(File, modified(Loaded)),
    catch(time_file(File, Now), error(_, _), fail),
    Now > Loaded,
    \+ said(File, Now),
    assertz(said(File, Now)).

prolog:message(ev3dev(changed(Path))) -->
    { file_base_name(Path, File) },
    [ '~w has changed since it was loaded. Type `make.` to load it again'-
      [File] ].

% ---------------- IN THE MENU OF CTRL-C

user:message_hook(Message, _, _) :-
    thread_self(main),
    ev3dev_queries:menu(Message),
    fail.

%   Time goes on with whatever is printed next: not every choice says so.

menu(interrupt(begin)) :-
    !,
    (   is_simulated
    ->  \+ view_held_,
        view_pause_(true),
        brick(Brick),
        assertz(stands(Brick))
    ;   running_(Ports),
        Ports \== [],
        print_message(warning, ev3dev(go_on(Ports)))
    ).
menu(_) :-
    menu_is_over.

%   An abort has left with_brick/2 when it is printed, so that another brick
%   is in use. The one whose time stands may have been closed.

menu_is_over :-
    retract(stands(Brick)),
    catch(in_brick(Brick, ( is_simulated, view_pause_(false) )),
          error(existence_error(brick, _), _), fail).

%   Before it is printed, clean-ups may wait.
ev3dev_waits:time_goes_on :-
    thread_self(main),
    menu_is_over.

% ---------------- WHEN IT HAS ENDED

user:message_hook(Message, Kind, Lines) :-
    ev3dev_queries:ended(Message, Kind, Lines).

%   A query with an answer does not fail if there are no more answers.

ended(query(Answer), query, _) :-
    functor(Answer, Name, _),
    memberchk(Name, [yes, more]),
    retractall(query(_)),
    fail.
ended(Message, Kind, Lines) :-
    ends_query(Message, Kind),
    current_prolog_flag(break_level, _),
    thread_self(main),
    findall(Remark, remark(Message, Remark), Remarks),
    Remarks \== [],
    (   Kind == informational,
        current_prolog_flag(verbose, silent)
    ->  true
    ;   Kind == query
    ->  print_message_lines(user_output, kind(Kind), Lines),
        flush_output(user_output)
    ;   print_message_lines(user_error, kind(Kind), Lines)
    ),
    forall(one_of(Remarks, Remark), print_message(warning, Remark)).

ends_query(query(no), query).
ends_query('$aborted', _).
ends_query(unwind(abort), _).
ends_query(unhandled_exception(_), _).
ends_query(error(_, _), error).

remark(query(no), Remark) :-
    query(Query),
    (   why_failed(Query, Remark)
    ->  true
    ;   current_module(ev3dev_last_goal),
        Used = ev3dev_last_goal:used_robot,
        call(Used),
        Remark = ev3dev(failed(Query))
    ).
remark(_, ev3dev(still_run(Ports))) :-
    running_(Ports),
    Ports \== [].

prolog:message(ev3dev(still_run(Ports))) -->
    { listed(Ports, Listed) },
    [ '~w still running. Type `stop.`'-[Listed] ].
prolog:message(ev3dev(go_on(Ports))) -->
    { listed(Ports, Listed) },
    [ '~w still running while this waits: `a` ends the program'-[Listed] ].

listed(Ports, Listed) :-
    and_list(Ports, Names),
    ( Ports = [_] -> Verb = is ; Verb = are ),
    atomic_list_concat([Names, ' ', Verb], Listed).
