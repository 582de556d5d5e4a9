:- module(ev3dev_view_page,
          [ pages_serve/3,              % +Address, ?Port, +Token
            pages_close/0,
            page_says/2,                % +Page, +Line
            page_settings/2,            % +Rate, +Goals
            word_rest/3                 % +Line, -Word, -Rest
          ]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../native/native',
              [ view_end_/2, view_frame_/6, view_hear_/3, view_leave_/1,
                view_say_/2, view_serve_/5, view_shut_/1, view_visit_/1 ]).
:- use_module(goals, [goal_line/4, goals_end/1]).
:- use_module(controls, [hand_line/3]).
:- use_module(record, [record_line/4]).
:- use_module(static_state, [brick_show/1, renew_kept/0]).
:- use_module(log, [error_text/2, log_commands/1, mark/1, note/2]).
:- use_module(program,
              [ lift_latch/0, probe_program/0, program_state/1,
                stop_program/0, view_thread/0
              ]).
:- use_module(source, [renew_active/0, source_leave/1, source_line/4]).
:- use_module(worlds, [world_line/3]).

/** <module> The conversations with pages

The server is native (`crates/door`). Here is a thread that waits for its
visitors, and a thread for each page that has come. A page is a number. It
asks for a frame when it has drawn the one before; so a page that does not
draw costs nothing. A frame that is asked for too early is held back, and what
else the page says is done meanwhile.
*/

:- dynamic
    porter/1,                           % Thread
    settings/3,                         % Interval, Rate, Goals
    files_directory/1.

settings(0.05, 20, false).

:- prolog_load_context(directory, Here),
   atom_concat(Here, '/../../view', Directory),
   assertz(files_directory(Directory)).

%!  page_settings(+Rate, +Goals) is det.
%
%   At most Rate frames in a second for a page; Goals says whether a page may
%   send goals.

page_settings(Rate, Goals) :-
    Interval is 1.0 / Rate,
    retractall(settings(_, _, _)),
    assertz(settings(Interval, Rate, Goals)).

%!  pages_serve(+Address, ?Port, +Token) is det.
%
%   Serve pages at a port of localhost, or of any address, from now on.
%
%   @error permission_error(open, port, Port)

pages_serve(Address, Port, Token) :-
    (   var(Port)
    ->  Wanted = 0
    ;   Wanted = Port
    ),
    files_directory(Directory),
    view_serve_(Address, Wanted, Token, Directory, Served),
    (   integer(Served)
    ->  Port = Served
    ;   throw_error(permission_error(open, port, Port), view/1, Served)
    ),
    thread_create(ev3dev_view_page:receive_visitors, Porter, []),
    assertz(porter(Porter)).

%!  pages_close is det.
%
%   Say good-bye to all pages, and end the server.

pages_close :-
    view_shut_(json([type=bye, why=stopped])),
    forall(retract(porter(Porter)),
           thread_join(Porter, _)).

receive_visitors :-
    view_thread,
    repeat,
    (   view_visit_(Visitor)
    ->  catch(receive(Visitor), _, true),
        fail
    ;   !
    ).

receive(stop) :-
    !,
    stop.
%   While Prolog halts, version 10 creates no thread.
receive(Page) :-
    catch(thread_create(ev3dev_view_page:page_serve(Page), _,
                        [detached(true)]),
          error(_, _), view_leave_(Page)).

%   Serve a page until either side ends it.
page_serve(Page) :-
    view_thread,
    setup_call_cleanup(
        true,
        ignore(catch(( probe_program, converse(Page, none, 0) ), _, true)),
        ( view_leave_(Page), goals_end(Page), source_leave(Page) )).

%   Wanted is what the page has that wants a frame, or `none`; Last is when it
%   got the last one.
converse(Page, Wanted, Last) :-
    time_left(Wanted, Last, Left),
    (   view_hear_(Page, Left, Line)
    ->  heard(Line, Page, Wanted, Last)
    ;   true
    ).

time_left(none, _, 10).
time_left(wanted(_), Last, Left) :-
    settings(Interval, _, _),
    get_time(Now),
    Left is max(0, Last + Interval - Now).

heard(none, Page, wanted(Have), _) :-
    !,
    frame_sent(Page, Have, Wanted),
    get_time(Now),
    converse(Page, Wanted, Now).
heard(none, Page, none, Last) :-
    !,
    converse(Page, none, Last).
heard(Line, Page, Wanted0, Last) :-
    word_rest(Line, Word, Rest),
    (   Word == next
    ->  due(Rest, Last, Page, Wanted, Last1),
        converse(Page, Wanted, Last1)
    ;   line(Word, Rest, Page)
    ->  converse(Page, Wanted0, Last)
    ;   view_end_(Page, 1008)
    ).

%!  page_says(+Page, +Line) is semidet.
%
%   Do what a page says that is served without a thread of its own: it gets
%   each frame at once. Fails if that is not a line.

page_says(Page, Line) :-
    word_rest(Line, Word, Rest),
    (   Word == next
    ->  frame_send(Page, Rest, false)
    ;   line(Word, Rest, Page)
    ).

%   A frame that is due is sent at once.
due(Have, Last, Page, Wanted, Last1) :-
    settings(Interval, _, _),
    get_time(Now),
    (   Now >= Last + Interval - 0.0005
    ->  frame_sent(Page, Have, Wanted),
        Last1 = Now
    ;   Wanted = wanted(Have),
        Last1 = Last
    ).

%   A page that has all there is waits for a change.
frame_sent(Page, Have, Wanted) :-
    (   frame_send(Page, Have, true)
    ->  Wanted = none
    ;   Wanted = wanted(Have)
    ).

frame_send(Page, Have, Waits) :-
    settings(_, Rate, Goals),
    program_state(State),
    renew_kept,
    renew_active,
    (   State == idle
    ->  log_commands(true)
    ;   log_commands(false)
    ),
    view_frame_(Page, Have, State, Rate, Goals, Waits).

%!  word_rest(+Line, -Word, -Rest) is det.
%
%   The word that a line of a page begins with, and what stands after it, a
%   string, empty if nothing does.

word_rest(Line, Word, Rest) :-
    (   sub_string(Line, Before, 1, After, " ")
    ->  sub_atom(Line, 0, Before, _, Word),
        sub_string(Line, _, After, 0, Rest)
    ;   atom_string(Word, Line),
        Rest = ""
    ).

%   What a page says is one of these; nothing of it is ever called.
line(stop, "", Page) :-
    !,
    stop,
    done(Page, stop, []).
line(go, "", Page) :-
    !,
    lift_latch,
    done(Page, go, []).
line(mark, Text0, Page) :-
    !,
    string_length(Text0, Length),
    Length > 0,
    End is min(200, Length),
    sub_string(Text0, 0, End, _, Text),
    mark(Text),
    done(Page, mark, []).
line(brick, Name, Page) :-
    !,
    (   brick_show(Name)
    ->  done(Page, brick, [])
    ;   format(string(Why), "There is no brick ~w.", [Name]),
        refused(Page, brick, Why)
    ).
line(Word, Rest, Page) :-
    memberchk(Word, [goal, more, enough, input]),
    !,
    settings(_, _, Goals),
    (   Goals == true
    ->  goal_line(Word, Rest, Page, Refused),
        (   nonvar(Refused)
        ->  refused(Page, Word, Refused)
        ;   true
        )
    ;   refused(Page, Word, "Goals are not allowed: view([goals(true)]).")
    ).
line(Word, Rest, Page) :-
    (   world_line(Word, Rest, Answer)
    ->  true
    ;   source_line(Word, Rest, Page, Answer)
    ->  true
    ;   record_line(Word, Rest, Page, Answer)
    ->  true
    ;   hand_line(Word, Rest, Answer)
    ),
    (   Answer = done(More)
    ->  done(Page, Word, More)
    ;   Answer = refused(Why)
    ->  refused(Page, Word, Why)
    ;   Answer = refused(Why, More)
    ->  refused(Page, Word, Why, More)
    ;   true
    ).

%   First it stops, then it says so.
stop :-
    program_state(State),
    stop_program,
    (   State == idle
    ->  note(stop, "STOP: all motors brake")
    ;   note(stop, "STOP: all motors brake, and the program ends")
    ).

done(Page, Word, More) :-
    view_say_(Page, json([type=done, what=Word|More])).

refused(Page, Word, Why) :-
    refused(Page, Word, Why, []).

refused(Page, Word, Why0, More) :-
    (   string(Why0)
    ->  Why = Why0
    ;   error_text(Why0, Why)
    ),
    view_say_(Page, json([type=refused, what=Word, why=Why|More])).
