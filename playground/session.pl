:- module(ev3dev_playground,
          [ session/0
          ]).
:- use_module(library(apply), [maplist/2]).
:- use_module(library(listing), [portray_clause/1]).
:- use_module(library(lists)).
:- use_module(library(prolog_codewalk), [prolog_walk_code/1]).
:- use_module(library(prolog_wrap), [wrap_predicate/4]).
:- use_module(library(readutil), []).
:- use_module(library(wasm), [(:=)/2, await/2, op(700, xfx, :=)]).
% What is typed finds them without a program.
:- user:use_module(library(ev3dev)).
:- user:use_module('../prolog/ev3dev/private/help/own_help').
:- user:use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/sim), []).
:- use_module(library(ev3dev/time), [wait/1]).
:- use_module('../prolog/ev3dev/private/native/native',
              [ brick_use_/1, running_/1, view_hear_/3, view_held_/0,
                view_open_/0, view_pace_/1, view_say_/2, view_step_/2,
                view_stop_motors_/0, view_thread_/1 ]).
:- use_module('../prolog/ev3dev/private/run/brick', [brick/1]).
:- use_module(check, [checked/4, checking/0]).
:- use_module('../prolog/ev3dev/private/errors/frames', [program/1]).
:- use_module('../prolog/ev3dev/private/explain/error_messages',
              [call_line/3]).
:- use_module('../prolog/ev3dev/private/explain/last_goal',
              [forget_goals/0, goals_end/0, spare_memory/0]).
:- use_module('../prolog/ev3dev/private/view/goals', [goal_solve/5]).
:- use_module('../prolog/ev3dev/private/view/jog', [jog_round/2]).
:- use_module('../prolog/ev3dev/private/view/log',
              [ error_text/2, leave_messages/0, lines_text/2, note/2,
                watch_messages/0 ]).
:- use_module('../prolog/ev3dev/private/view/page',
              [page_says/2, page_settings/2, word_rest/3]).
:- use_module('../prolog/ev3dev/private/view/program',
              [is_stopping/0, part_begins/1, stop_program/0, stopped/0]).
:- use_module('../prolog/ev3dev/private/view/worlds', [worlds_settings/1]).

/** <module> Prolog in a page

Prolog runs in a worker of the page, in one thread. It waits for a line of the
page, which says what is to be done: the lines of docs/view-protocol.md, and
these:

| line | meaning |
|---|---|
| `run NAME TEXT` | load TEXT as the program NAME, and run it |
| `load NAME TEXT` | load it only |
| `check NAME EXERCISE TEXT` | try it on an exercise of the course |
| `goal N TEXT`, `more N`, `enough N` | as there |

`run` and `load` are answered by `done` with `errors`, a list of
`{"line":3,"kind":"warning","text":".."}`. A warning of a program that runs
comes as `{"type":"raised","line":12,"kind":"warning","text":".."}`. After a goal that
has ended by an error comes `{"type":"raised","line":12}`: the line of the
program in which that was.

While the program runs, it lets the page go on between two slices of a wait,
and after some thousand inferences: what the page has said is done then, and
the page is sent a frame. STOP is an abort at such a place.
*/

:- dynamic
    began/0,
    driving/1,                          % Round
    deferred/1,                         % Line: what is done when the program has ended
    found/3,                            % Line, Kind, Text: of the program that is loaded
    first_library/1,                    % File: what is there without a program
    imported_first/1,                   % Head: what it exports
    loading/0,
    program_file/1,
    raised/2,                           % Clause, PC: of the last error
    tracing_goals/0,
    typed/1,                            % Stream: has lines that were typed
    warned/0.

%   The page has no number: there is one.
page(0).

%   So many inferences until the page may go on again. Prolog looks at each 16th
%   one, so a sixteenth of it has to be odd.
beat(2032).

%!  session
%
%   Do what the page says. Left only by an exception, as an abort; then it is
%   to be called again.

session :-
    (   began
    ->  true
    ;   begin
    ),
    retractall(loading),
    set_prolog_flag(heartbeat, 0),
    goals_end,
    nb_setval(ev3dev_playground_turn, off),
    output_noted,
    stopped,
    repeat,
    (   retract(deferred(Line))
    ->  true
    ;   next_line(Line)
    ),
    attend(Line),
    fail.

begin :-
    assertz(began),
    forall(imported(Head), assertz(imported_first(Head))),
    findall(File,
            ( imported_first(Head),
              predicate_property(user:Head, imported_from(Module)),
              module_property(Module, file(File)) ),
            Files0),
    sort(Files0, Files),
    forall(member(File, Files), assertz(first_library(File))),
    import_first,
    page_settings(60, true),
    worlds_settings(localhost),
    watch_messages,
    watch_reads,
    asserta((user:message_hook(Message, Kind, Lines) :-
                 ev3dev_playground:of_program(Kind, Message, Lines))),
    set_stream(user_output, buffer(line)),
    view_open_,
    working_directory(_, '/home/web_user'),
    ev3dev_sim:sim_start(room, [seed(1)]),
    as_hand(view_pace_(1.0)).

%   What a person does takes no simulated time. It concerns the brick that is
%   shown, and the program goes on with its own.
as_hand(Goal) :-
    brick(Brick),
    setup_call_cleanup(
        view_thread_(true),
        once(Goal),
        ( view_thread_(false), ignore(brick_use_(Brick)) )).

% ---------------- LINES

%   Waits for it; somebody may drive meanwhile, or motors may still run.
next_line(Line) :-
    page(Page),
    view_hear_(Page, 0, Line0),
    (   Line0 \== none
    ->  Line = Line0
    ;   as_hand(drives)
    ->  pause(20),
        next_line(Line)
    ;   Promise := ev3dev_line(),
        await(Promise, _),
        next_line(Line)
    ).

drives :-
    (   retract(driving(Round0))
    ->  true
    ;   get_time(Now),
        Round0 = Now-none
    ),
    (   jog_round(Round0, Round)
    ->  true
    ;   goes_on(Round0, Round)
    ),
    assertz(driving(Round)).

%   Motors that a goal has left running go on while the next one is typed.
goes_on(Before-_, Now-none) :-
    running_([_|_]),
    \+ view_held_,
    get_time(Now),
    Passed is min(0.1, Now-Before),
    view_step_(Passed, true).

pause(Milliseconds) :-
    Promise := ev3dev_turn(Milliseconds),
    await(Promise, _).

attend(Line) :-
    word_rest(Line, Word, Rest),
    (   memberchk(Word, [run, load])
    ->  word_rest(Rest, Name, Text),
        program(Word, Name, Text)
    ;   Word == check
    ->  word_rest(Rest, Name, Rest1),
        word_rest(Rest1, Exercise, Text),
        check(Name, Exercise, Text)
    ;   Word == goal
    ->  word_rest(Rest, Number0, Text),
        atom_number(Number0, Number),
        goal(Text, Number)
    ;   hand(Line)
    ).

hand(Line) :-
    page(Page),
    (   as_hand(page_says(Page, Line))
    ->  true
    ;   true
    ).

% ---------------- THE PROGRAM

%   The program begins as in a Prolog that was just started, in the world as it
%   is.
program(Word, Name, Text) :-
    forget_program,
    forgotten,
    program_written(Name, Text, File),
    assertz(program_file(File)),
    retractall(found(_, _, _)),
    retractall(tracing_goals),
    (   sub_string(Text, _, _, _, "library(ev3dev")
    ->  true
    ;   % Here it is there without that, elsewhere it is not.
        finding(1, "The program does not load the robot\u2019s library: it \c
                    begins with :- use_module(library(ev3dev)).")
    ),
    running(loaded(File)),
    findall(json([line=Line, kind=Kind, text=Said]),
            found(Line, Kind, Said), Found),
    page(Page),
    view_say_(Page, json([type=done, what=Word, errors=Found])),
    (   found(_, "error", _)
    ->  true
    ;   Word \== run
    ->  true
    ;   entry(Text, Goals)
    ->  forall(member(Goal, Goals), goal(Goal, 0))
    ;   note(warning, "The program is loaded, but it has no start/0 to begin \c
                       with. Write `start :-` and its commands after it, \c
                       with commas between them, or type a query.")
    ).

%   But what began the world is still known: `Back to the start` begins it again.
forgotten :-
    findall(Fact,
            ( member(Fact, [noted(0, _, _), name(0, _)]),
              ev3dev_world_name:Fact ),
            Kept),
    forall(ev3dev_brick:forget(0), true),
    forall(member(Fact, Kept), assertz(ev3dev_world_name:Fact)).

forget_program :-
    retractall(program_file(_)),
    forget_goals,
    forall(( program(Former), \+ sub_atom(Former, 0, _, _, '/pack/') ),
           unload_file(Former)),
    forall(( predicate_property(user:Head, dynamic),
             \+ predicate_property(user:Head, imported_from(_)),
             \+ predicate_property(user:Head, multifile) ),
           retractall(user:Head)),
    forall(( imported(Head),
             \+ imported_first(Head) ),
           ( functor(Head, Name, Arity),
             catch(abolish(user:Name/Arity), error(_, _), true) )),
    % A domain of library(ev3dev/golog) is declared again.
    retractall(ev3dev_golog:declared(user, _)),
    forall(( ev3dev_golog:vocabulary(Name/Arity),
             functor(Head, Name, Arity),
             predicate_property(user:Head, dynamic) ),
           retractall(user:Head)),
    import_first.

%   A saved state has forgotten that a program may define again what a library
%   exports.
import_first :-
    forall(( imported_first(Head), imported(Head) ),
           ( functor(Head, Name, Arity),
             abolish(user:Name/Arity) )),
    forall(first_library(File),
           user:use_module(File)).

imported(Head) :-
    predicate_property(user:Head, imported_from(Module)),
    sub_atom(Module, 0, _, _, ev3dev).

program_written(Name, Text, File) :-
    absolute_file_name(Name, File),
    setup_call_cleanup(
        open(File, write, Out, [encoding(utf8)]),
        write(Out, Text),
        close(Out)).

%   Try the program on an exercise of the course.
check(_, Exercise, _) :-
    exercise_file(Exercise, Path),
    \+ exists_file(Path),
    !,
    format(string(Said), "There is no exercise ~w.", [Exercise]),
    note(warning, Said).
check(Name, Exercise, Text) :-
    program_written(Name, Text, File),
    exercise_file(Exercise, Path),
    leave_messages,
    running(call_cleanup(
                checked(File, Path, ev3dev_playground:forget_program, Found),
                watch_messages)),
    (   nonvar(Found)
    ->  Found = found(Points, Of, Seed, Said),
        page(Page),
        view_say_(Page, json([ type=done, what=check, points=Points, of=Of,
                               seed=Seed, text=Said ]))
    ;   true
    ).

exercise_file(Exercise, Path) :-
    atomic_list_concat(['/pack/course/', Exercise, '/exercise.pl'], Path).

loaded(File) :-
    setup_call_cleanup(
        assertz(loading),
        load_files(user:File, []),
        retractall(loading)),
    prolog_walk_code([ undefined(trace), source(true), trace_reference(-),
                       module(user), on_trace(ev3dev_playground:lacking) ]).

:- public lacking/3.

lacking(Called0, _, Location) :-
    strip_module(Called0, _, Called),
    functor(Called, Name, Arity),
    line_of(Location, Line),
    PI = Name/Arity,
    error_text(error(existence_error(procedure, PI), PI), Text),
    finding(Line, Text).

line_of(clause_term_position(Clause, Position), Line) :-
    !,
    arg(1, Position, Start),
    clause_property(Clause, file(File)),
    setup_call_cleanup(
        open(File, read, In, [encoding(utf8)]),
        ( read_string(In, Start, _),
          line_count(In, Line) ),
        close(In)).
line_of(clause(Clause), Line) :-
    clause_property(Clause, line_count(Line)).

%   A warning about a line, also in the log.
finding(Line, Text) :-
    finding(warning, Line, Text).

finding(Kind, Line, Text) :-
    (   found(Line, _, Text)
    ->  true
    ;   atom_string(Kind, Word),
        assertz(found(Line, Word, Text)),
        format(string(Said), "line ~d: ~s", [Line, Text]),
        note(Kind, Said)
    ).

%   The goals that a program is begun by: the queries of its comments up to the
%   first that it defines, such as `?- sim_start(delivery).` and `?- start.`;
%   else one of the usual names.
entry(Text, Goals) :-
    split_string(Text, "\n", "", Lines),
    findall(Query, ( member(Line, Lines), query_in(Line, Query) ), Queries),
    Queries = [First|_],
    !,
    (   append(Before, [Own|_], Queries),
        own(Own)
    ->  append(Before, [Own], Goals)
    ;   Goals = [First]
    ).
entry(_, [Goal]) :-
    member(Name, [start, main, go]),
    current_predicate(user:Name/0),
    !,
    atom_string(Name, Goal).

query_in(Line, Query) :-
    string_concat("%", Comment, Line),
    split_string(Comment, "", " .\r", [Query0]),
    string_concat("?- ", Query1, Query0),
    (   sub_string(Query1, Before, _, _, ". ")
    ->  sub_string(Query1, 0, Before, _, Query)
    ;   Query = Query1
    ).

own(Query) :-
    catch(term_string(Goal, Query), error(_, _), fail),
    callable(Goal),
    program_file(File),
    predicate_property(user:Goal, file(File)).

goal(Text, Number) :-
    page(Page),
    retractall(raised(_, _)),
    retractall(warned),
    open_string("", In),
    running(traced(goal_solve(Text, Page, Number, In, answered))),
    (   retract(raised(Clause, PC))
    ->  call_line(Clause, PC, Line),
        view_say_(Page, json([type=raised, line=Line]))
    ;   true
    ).

%   Here nothing is watched: frames of last calls would be kept in libraries,
%   too, which may call themselves millions of times.
:- multifile ev3dev_view_goals:failed/1.

ev3dev_view_goals:failed(Goal) :-
    \+ retract(warned),                 % that says why
    callable(Goal),
    program_file(File),
    predicate_property(user:Goal, file(File)),
    format(string(Said), "~p is false: a goal in it has failed. To see which \c
                          one, type `trace, ~p.`", [Goal, Goal]),
    note(warning, Said).

raised_at(Line, Text) :-
    page(Page),
    view_say_(Page, json([type=raised, line=Line, kind=warning, text=Text])).

%   Of all modules, those of the pack among them, a person means the program.
user:listing :-
    ev3dev_playground:listed(_).

user:listing(What) :-
    ev3dev_playground:listed(What).

listed(What) :-
    findall(Own, own_predicate(What, Own), All),
    (   All == [],
        nonvar(What)
    ->  prolog_listing:listing(user:What)
    ;   forall(member(Own, All), list_own(Own))
    ).

%   listing/1 would look for Name/Arity in other modules, too.
list_own(Name/Arity) :-
    functor(Head, Name, Arity),
    (   predicate_property(user:Head, dynamic)
    ->  format(":- dynamic ~q.~n~n", [Name/Arity])
    ;   true
    ),
    forall(clause(user:Head, Body, Clause),
           ( ignore(prolog_listing:restore_variable_names(user, Head, Body,
                                                          Clause, [])),
             portray_clause((Head :- Body)) )),
    nl.

own_predicate(What, Name/Arity) :-
    (   var(What)
    ->  program_file(File)
    ;   What = Name/Arity
    ->  true
    ;   atom(What),
        Name = What
    ),
    current_predicate(user:Name/Arity),
    functor(Head, Name, Arity),
    \+ predicate_property(user:Head, imported_from(_)),
    (   var(What)
    ->  ( predicate_property(user:Head, file(File)) -> true
        ; predicate_property(user:Head, dynamic),
          \+ predicate_property(user:Head, multifile),
          \+ predicate_property(user:Head, thread_local) )
    ;   true
    ).

%   What a computer has, and a page has not.
:- redefine_system_predicate(user:shell(_)).
:- redefine_system_predicate(user:shell(_, _)).

user:shell(_) :-
    ev3dev_playground:no_shell(shell/1).

user:shell(_, _) :-
    ev3dev_playground:no_shell(shell/2).

no_shell(Called) :-
    throw(error(existence_error(shell, page),
                context(Called, 'a page has no shell'))).

:- multifile prolog:error_message//1.

prolog:error_message(context_error(edit, _)) -->
    [ 'the program is in the editor of the page already' ].

%   What somebody types who knows nothing.
:- redefine_system_predicate(user:help).

user:help :-
    ev3dev_playground:note(output,
                           "help(go_cm). explains a predicate, and \c
                            apropos(distance). finds those about a word.").

%   A program may end itself, not Prolog.
:- redefine_system_predicate(user:halt).
:- redefine_system_predicate(user:halt(_)).

user:halt :-
    halt(0).

user:halt(Status) :-
    ev3dev_playground:halted(Status).

halted(Status) :-
    checking,
    !,
    throw(ev3dev_halt(Status)).
halted(_) :-
    view_stop_motors_,
    note(stop, "halt: the program ends, and all motors brake"),
    abort.

% ---------------- WHAT THE PROGRAM READS

%   The page's line for queries answers what reads from user_input, in
%   programs and in libraries.
:- redefine_system_predicate(user:consult(_)).
:- redefine_system_predicate(user:'[|]'(_, _)).

user:consult(File) :-
    ev3dev_playground:consulted(File).

user:[File|Files] :-
    ev3dev_playground:consulted([File|Files]).

consulted(Files) :-
    (   is_list(Files)
    ->  maplist(consulted, Files)
    ;   Files == user
    ->  consult_typed
    ;   user:load_files(Files, [])
    ).

%   reads(Name, Arity, Needs): with so many arguments it reads from the
%   current input, and with one more, the first, from a stream.
reads(read, 1, term).
reads(read_term, 2, term).
reads(get_char, 1, line).
reads(get_code, 1, line).
reads(peek_char, 1, line).
reads(peek_code, 1, line).
reads(skip, 1, line).
reads(read_string, 2, line).
reads(read_string, 4, line).
reads(read_line_to_codes, 1, line).
reads(read_line_to_codes, 2, line).

watch_reads :-
    forall(( reads(Name, Bare, Needs),
             member(Module-More, [system-0, system-1, read_util-1]),
             Arity is Bare + More,
             functor(Head, Name, Arity),
             predicate_property(Module:Head, defined),
             \+ predicate_property(Module:Head, imported_from(_)) ),
           wrap_predicate(Module:Head, ev3dev_page, Reads,
                          ev3dev_playground:read_typed(More, Needs, Head,
                                                       Reads))).

read_typed(0, Needs, _, Reads) :-
    current_input(In),
    (   is_typed(In)
    ->  type_more(Needs)
    ;   true
    ),
    call(Reads).
read_typed(1, Needs, Head, Reads) :-
    arg(1, Head, In),
    (   In == user_input
    ->  type_more(Needs),
        call(Reads)
    ;   is_typed(In)
    ->  Head =.. [Name, _|Arguments],
        Again =.. [Name, user_input|Arguments],
        read_util:Again
    ;   call(Reads)
    ).

is_typed(In) :-
    typed(In),
    !.
is_typed(In) :-
    catch(stream_property(In, alias(user_input)), error(_, _), fail).

%   If user_input has no term or line, have it typed: then another stream is
%   user_input.
type_more(Needs) :-
    stream_property(Former, alias(user_input)),
    (   typed(Former)
    ->  peek_string(Former, 1000000, Rest)
    ;   Rest = ""
    ),
    (   enough(Needs, Rest)
    ->  true
    ;   can_yield
    ->  typed_lines(Needs, Rest, Text),
        open_string(Text, New),
        current_input(Current),
        (   is_typed(Current)
        ->  set_input(New)
        ;   true
        ),
        assertz(typed(New)),
        set_stream(New, alias(user_input))
    ;   note(warning, "Nothing can be typed while an engine runs: read \c
                       before it begins.")
    ).

forget_typed :-
    forall(retract(typed(In)), close(In, [force(true)])).

%   Clauses, until a line has nothing in it.
consult_typed :-
    note(output, "Type clauses. A line with nothing in it ends them."),
    typed_lines(clauses, "", Text),
    absolute_file_name('typed.pl', File),
    setup_call_cleanup(
        open_string(Text, In),
        load_files(user:File, [stream(In)]),
        close(In)).

typed_lines(Needs, Before, Text) :-
    output_noted,
    page(Page),
    view_say_(Page, json([type=reads, what=Needs])),
    typed_line(Line),
    string_concat(Before, Line, Text0),
    (   enough(Needs, Text0)
    ->  Text = Text0
    ;   typed_lines(Needs, Text0, Text)
    ).

enough(line, Text) :-
    Text \== "".
enough(term, Text) :-
    split_string(Text, "", " \n", [Bare]),
    sub_string(Bare, _, 1, 0, ".").
enough(clauses, Text) :-
    (   Text == "\n"
    ;   sub_string(Text, _, 2, 0, "\n\n")
    ;   sub_string(Text, _, 13, 0, "end_of_file.\n")
    ),
    !.

%   Meanwhile the page is served, and STOP is heard.
typed_line(Typed) :-
    beat(Beat),
    setup_call_cleanup(
        ( set_prolog_flag(heartbeat, 0),
          nb_setval(ev3dev_playground_turn, on) ),
        typed_or_stopped(Typed),
        ( nb_setval(ev3dev_playground_turn, off),
          set_prolog_flag(heartbeat, Beat) )),
    (   is_stopping
    ->  interrupted
    ;   true
    ).

typed_or_stopped(Typed) :-
    next_line(Line),
    word_rest(Line, Word, Rest),
    (   Word == input
    ->  string_concat(Rest, "\n", Typed)
    ;   heard(Line),
        (   is_stopping
        ->  true
        ;   typed_or_stopped(Typed)
        )
    ).

% ---------------- THE TRACER

%   Nobody presses keys for it: it prints what the program calls, and goes on.
%   After `trace.` alone it does so with the next goals, too.

:- multifile user:prolog_trace_interception/4.
:- dynamic user:prolog_trace_interception/4.

user:prolog_trace_interception(Port, Frame, _, continue) :-
    ev3dev_playground:traced(Port, Frame).

traced(Goal) :-
    (   tracing_goals
    ->  trace
    ;   true
    ),
    setup_call_cleanup(true, Goal, traced_so_far).

traced_so_far :-
    (   tracing
    ->  nodebug,
        (   tracing_goals
        ->  true
        ;   assertz(tracing_goals),
            note(output, "The tracer prints each call of your program from \c
                          now on. `notrace.` ends that.")
        )
    ;   nodebug,
        retractall(tracing_goals)
    ).

traced(Port, Frame) :-
    functor(Port, Name, _),
    memberchk(Name-Word, [ call-"Call", exit-"Exit", fail-"Fail",
                           redo-"Redo", exception-"Exception" ]),
    prolog_frame_attribute(Frame, goal, Goal),
    is_of_program(Frame),
    !,
    prolog_frame_attribute(Frame, level, Level),
    ( Goal = user:Plain -> true ; strip_module(Goal, _, Plain) ),
    format(user_output, "~s: (~d) ~p~n", [Word, Level, Plain]).
traced(_, _).

%   The program's own goals, and what it calls directly.
is_of_program(Frame) :-
    program_file(File),
    (   prolog_frame_attribute(Frame, goal, Goal),
        predicate_property(user:Goal, file(File))
    ->  true
    ;   prolog_frame_attribute(Frame, parent, Parent),
        prolog_frame_attribute(Parent, clause, Clause),
        clause_property(Clause, file(File))
    ).

%   Where the last error was that was thrown, caught or not.
:- multifile prolog:prolog_exception_hook/5.

prolog:prolog_exception_hook(error(_, _), _, Frame, _, _) :-
    ev3dev_playground:thrown_in(Frame),
    fail.

thrown_in(Frame) :-
    program_file(File),
    in_program(Frame, none, File, Clause, PC),
    retractall(raised(_, _)),
    assertz(raised(Clause, PC)).

%   PC is where the clause goes on.
in_program(Frame, PC0, File, Clause, PC) :-
    (   prolog_frame_attribute(Frame, clause, Clause0),
        clause_property(Clause0, file(File))
    ->  Clause = Clause0,
        PC = PC0
    ;   prolog_frame_attribute(Frame, parent, Parent),
        ( prolog_frame_attribute(Frame, pc, PC1) -> true ; PC1 = none ),
        in_program(Parent, PC1, File, Clause, PC)
    ).

%   Wait for what the page says of an answer. Whatever else is to be solved
%   ends this goal.
answered(Word) :-
    set_prolog_flag(heartbeat, 0),
    next_line(Line),
    word_rest(Line, Word0, _),
    (   memberchk(Word0, [more, enough])
    ->  Word = Word0
    ;   ends(Word0)
    ->  assertz(deferred(Line)),
        Word = enough
    ;   hand(Line),
        answered(Word)
    ),
    beat(Beat),
    set_prolog_flag(heartbeat, Beat).

%   Lines that end a program.
ends(check).
ends(run).
ends(load).
ends(goal).
ends(reset).
ends(begin).
ends(choose).

%   Run Goal as the program, with the page going on.
running(Goal) :-
    part_begins(main),
    beat(Beat),
    setup_call_cleanup(
        set_prolog_flag(heartbeat, Beat),
        ignore(Goal),
        ( set_prolog_flag(heartbeat, 0),
          goals_end,
          forget_typed )),
    output_noted,
    stopped.

% ---------------- THE TURN

:- multifile
    ev3dev_waits:page_turn/0,
    prolog:heartbeat/0.

ev3dev_waits:page_turn :-
    turn.

:- abolish(prolog:heartbeat/0).

prolog:heartbeat :-
    turn.

%   Let the page go on, if it is time to, or if simulated time is held back.
turn :-
    nb_current(ev3dev_playground_turn, off),
    !,
    spare_memory,
    (   view_held_
    ->  Held = true
    ;   Held = false
    ),
    (   can_yield
    ->  (   Held == true
        ->  let_in(4)
        ;   Due := ev3dev_due(),
            Due == true
        ->  let_in(0)
        ;   true
        )
    ;   Held == true
    ->  % It cannot wait here.
        as_hand(view_step_(0.02, false))
    ;   true
    ).
turn.

%   Not within a call of Prolog from elsewhere. Within an engine Prolog would
%   never yield again.
can_yield :-
    \+ engine_self(_),
    '$can_yield'.

let_in(Milliseconds) :-
    nb_setval(ev3dev_playground_turn, on),
    pause(Milliseconds),
    hear_all,
    nb_setval(ev3dev_playground_turn, off),
    (   is_stopping
    ->  interrupted
    ;   view_held_
    ->  let_in(4)
    ;   true
    ).

%   Its end is not interrupted once more.
interrupted :-
    set_prolog_flag(heartbeat, 0),
    abort.

hear_all :-
    output_noted,
    page(Page),
    view_hear_(Page, 0, Line),
    (   Line == none
    ->  true
    ;   heard(Line),
        hear_all
    ).

heard(Line) :-
    word_rest(Line, Word, _),
    (   Word == goal
    ->  page(Page),
        view_say_(Page, json([ type=refused, what=goal,
                               why="A program runs. STOP ends it." ]))
    ;   ends(Word)
    ->  as_hand(stop_program),
        assertz(deferred(Line))
    ;   hand(Line)
    ).

%   On a PC a simulation in real time goes on while a program sleeps.
:- redefine_system_predicate(user:sleep(_)).

user:sleep(Seconds) :-
    (   ev3dev_playground:checking
    ->  system:sleep(Seconds)
    ;   ev3dev_time:wait(Seconds)
    ).

% ---------------- OUTPUT, MESSAGES

%   The browser speaks. Nobody says how long that takes.
:- multifile ev3dev_sound:spoken/2.

ev3dev_sound:spoken(Text, Wait) :-
    \+ ev3dev_playground:checking,
    ev3dev_playground:speak(Text, Wait).

speak(Text, Wait) :-
    format(string(Words), "~w", [Text]),
    format(string(Said), "the brick said ~s", [Words]),
    note(output, Said),
    page(Page),
    view_say_(Page, json([type=say, text=Words])),
    (   Wait == true
    ->  string_length(Words, Length),
        Seconds is 0.3 + 0.07*Length,
        wait(Seconds)
    ;   true
    ).

output_noted :-
    catch(flush_output(user_output), _, true),
    Text := ev3dev_printed(),
    (   atom_length(Text, 0)
    ->  true
    ;   note(output, Text)
    ).

%   What is said goes into the log, and is not printed as well.
:- multifile user:message_hook/3.

user:message_hook(Message, Kind, Lines) :-
    ev3dev_playground:began,
    \+ ev3dev_playground:checking,
    ev3dev_playground:said(Kind, Message, Lines).

said(informational, _, Lines) :-
    lines_text(Lines, Text0),
    string_concat("% ", Text0, Text),
    note(output, Text),
    fail.
said(Kind, _, Lines) :-
    (   Kind == warning
    ->  retractall(warned),
        assertz(warned),
        ignore(warned_at(Lines))
    ;   true
    ).

warned_at(Lines) :-
    program_file(File),
    prolog_current_frame(Frame),
    in_program(Frame, none, File, Clause, PC),
    call_line(Clause, PC, Line),
    lines_text(Lines, Text),
    raised_at(Line, Text).

%   At the start Prolog's own sleep/1 of a page comes too late.
user:message_hook(ignored_weak_import(user, wasm:_), _, _).

%   What is said of the program while it is loaded stands at its line.
of_program(Kind, Message, Lines) :-
    loading,
    memberchk(Kind, [warning, error]),
    (   place(Message, Line)
    ->  true
    ;   source_location(_, Line)
    ),
    lines_text(Lines, Text0),
    without_place(Text0, Text),
    finding(Kind, Line, Text).

place(error(_, Context), Line) :-
    nonvar(Context),
    (   Context = file(_, Line, _, _)
    ;   Context = stream(_, Line, _, _)
    ;   Context = file(_, Line)
    ).

without_place(Text, Rest) :-
    sub_string(Text, Before, _, After, ".pl:"),
    \+ ( sub_string(Text, At, 1, _, " "), At < Before ),
    sub_string(Text, _, After, 0, Place),
    split_string(Place, " ", "", [_|Words]),
    Words = [_|_],
    !,
    atomic_list_concat(Words, ' ', Rest0),
    atom_string(Rest0, Rest).
without_place(Text, Text).
