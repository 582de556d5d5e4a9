:- module(ev3dev_playground_check,
          [ checked/4,                  % +File, +Exercise, :Fresh, -Found
            checking/0
          ]).
:- use_module(library(lists), [member/2]).
:- use_module(library(readutil), [read_file_to_string/3]).
:- use_module(library(ev3dev/exercise), []).
:- use_module('../prolog/ev3dev/private/explain/last_goal', [goals_end/0]).
:- use_module('../prolog/ev3dev/private/journal/causes',
              [follow_no_more/0]).
:- use_module('../prolog/ev3dev/private/journal/fenced_log', [tell_to/1]).
:- use_module('../prolog/ev3dev/private/marking/mark', [tried/4]).
:- use_module('../prolog/ev3dev/private/marking/read',
              [ exercise_happens/2, exercise_setting/3, exercise_world/3,
                read_exercise/2 ]).
:- use_module('../prolog/ev3dev/private/marking/run',
              [marked_run/4, marking_exercise/2]).
:- use_module('../prolog/ev3dev/private/native/native',
              [stop_started_/0, view_pace_/1]).
:- use_module('../prolog/ev3dev/private/simulation/schedule',
              [plan/3, unplan/1]).
:- use_module('../prolog/ev3dev/sim', [sim_start/2]).
:- use_module('../prolog/ev3dev/sim_time', [sim_time/1]).

/** <module> Trying a program in a page

A page has no processes: the runs of `swipl ev3dev try` are made here, one
after the other, and their program is loaded beside this one. It earns what it
earns there, unless it draws random numbers or counts the time of a processor.
*/

:- meta_predicate checked(+, +, 0, -).

:- dynamic
    checking/0,
    fresh/1,                            % Goal: forgets the program
    endless/0,                          % a run has needed too many
                                        % inferences
    over/0,                             % the time of the run
    overdone/1.                         % Count: a goal has needed more

%!  checking is semidet.
%
%   A program is tried now.

%!  checked(+File, +Exercise, :Fresh, -Found) is semidet.
%
%   Try the program File on the open seeds of Exercise, and run it once more
%   in the worst of them, in the simulation of the page. Found is
%   found(Points, Of, Seed, Text): Text is what `swipl ev3dev try` prints.
%   Fresh forgets the program before.

checked(File, Exercise, Fresh, found(Points, Of, Seed, Text)) :-
    current_prolog_flag(stack_limit, Limit),
    setup_call_cleanup(
        ( assertz(checking), assertz(fresh(Fresh)) ),
        ( written('/tmp/tried',
                  tried(Exercise, File, [enclosed(false)], Marked), Text),
          Mark = mark(_, Points, Of, _, Runs, _),
          arg(2, Marked, Mark),
          findall(Earned-Each, member(run(Each, Earned, _, _), Runs), Pairs),
          keysort(Pairs, [_-Seed|_]),
          shown(File, Exercise, Seed) ),
        ( retractall(checking), retractall(fresh(_)), retractall(endless),
          set_prolog_flag(stack_limit, Limit) )).

shown(File, Exercise, Seed) :-
    read_exercise(Exercise, Read),
    exercise_world(Read, Seed, World),
    exercise_setting(Read, goal(Goal), start),
    exercise_setting(Read, seconds(Seconds), 60),
    exercise_setting(Read, noise(Noise), false),
    exercise_setting(Read, robot(Robot), default),
    sim_start(World, [ clock(virtual), seed(Seed), noise(Noise),
                       robot(Robot) ]),
    view_pace_(0.0),
    exercise_happens(Read, Seed),
    written('/tmp/shown', ended(File, Goal, Seconds, _), _),
    view_pace_(1.0).

%   What Goal prints, with its errors, is Text.
written(File, Goal, Text) :-
    stream_property(Out, alias(user_output)),
    stream_property(Errors, alias(user_error)),
    current_output(Current),
    setup_call_cleanup(
        ( open(File, write, Stream, [encoding(utf8)]),
          set_stream(Stream, alias(user_output)),
          set_stream(Stream, alias(user_error)),
          set_output(Stream) ),
        once(Goal),
        ( set_stream(Out, alias(user_output)),
          set_stream(Errors, alias(user_error)),
          set_output(Current),
          close(Stream) )),
    read_file_to_string(File, Text, [encoding(utf8)]).

:- multifile
    ev3dev_marking_mark:runs_here/4,
    ev3dev_sim_fenced:runs_here/4.

ev3dev_marking_mark:runs_here(Jobs, Exercise-Text, Programs, Results) :-
    ev3dev_playground_check:results(Jobs, Exercise-Text, Programs, Results).

results(Jobs, Exercise-Text, Programs, Results) :-
    marking_exercise(Exercise, Text),
    findall(job(Program, Seed, Result),
            ( member(Program-Seed, Jobs),
              memberchk(program(Program, _, Files, _, _), Programs),
              marked_run(Files, Seed, false, Result) ),
            Results).

ev3dev_sim_fenced:runs_here(File, run(Goal, Seed, Seconds), Output-Told,
                            Ended) :-
    ev3dev_playground_check:run(File, Goal, Seed, Seconds, Output, Told,
                                Ended).

run(File, Goal, Seed, Seconds, Output, Told, Ended) :-
    ( Seed == '' -> true ; set_random(seed(Seed)) ),
    setup_call_cleanup(
        ( Told == '' -> true ; tell_to(Told) ),
        written(Output, ended(File, Goal, Seconds, Ended), _),
        follow_no_more).

%   So many inferences may a run need: a program that computes without end
%   ends by that, whatever the clock of the page shows. No solution in the
%   course needs a tenth of it. After a run that has needed more, the others
%   get a quarter.
most_inferences(20000000).

may_need(Most) :-
    most_inferences(Most0),
    ( endless -> Most is Most0 // 4 ; Most = Most0 ).

%   So many bytes may its stacks have.
most_stack(256000000).

%   As a process would.
ended(File, Goal, Seconds, Ended) :-
    fresh(Fresh),
    call(Fresh),
    retractall(over),
    retractall(overdone(_)),
    most_stack(Bytes),
    set_prolog_flag(stack_limit, Bytes),
    sim_time(Now),
    Until is Now+Seconds,
    plan(Until, ev3dev_playground_check:time_is_up, Id),
    call_cleanup(
        catch(program(File, Goal, Status), Ball, true),
        ( unplan(Id), goals_end )),
    (   over
    ->  Ended = over
    ;   var(Ball)
    ->  Ended = exit(Status)
    ;   Ball = ev3dev_endless(Most)
    ->  Ended = limit(inferences(Most))
    ;   Ball = ev3dev_halt(Status)
    ->  Ended = exit(Status)
    ;   throw(Ball)
    ),
    stop_started_,
    call(Fresh).

time_is_up :-
    assertz(over),
    sim_time(Now),
    Again is Now+0.01,
    plan(Again, ev3dev_playground_check:time_is_up, _),
    throw(ev3dev_over).

program(File, Goal, Status) :-
    load_files(user:File, []),
    must_be_within,
    catch(( bounded(user:Goal) -> Why = none ; Why = failed ), Why, true),
    must_be_within,
    (   Why == none
    ->  Status = 0
    ;   ends_run(Why)
    ->  throw(Why)
    ;   format(atom(Text), "~q", [Goal]),
        print_message(error, init_goal_failed(Why, Text)),
        ( Why == failed -> Status = 1 ; Status = 2 )
    ).

must_be_within :-
    (   retract(overdone(Most))
    ->  throw(ev3dev_endless(Most))
    ;   true
    ).

%   Prolog catches what a directive throws, so each has a limit of its own, as
%   the goal has.
:- multifile user:term_expansion/2.
:- dynamic user:term_expansion/2.

bounded_directive((:- Goal0), (:- Goal)) :-
    callable(Goal0),
    loads_program(Module),
    (   Goal0 = initialization(Called)
    ->  Goal = initialization(Bounded)
    ;   is_run(Goal0),
        Called = Goal0,
        Goal = Bounded
    ),
    Bounded = ev3dev_playground_check:bounded(Module:Called),
    Called \= ev3dev_playground_check:_.

%   Module is that into which a file of the program is loaded now.
loads_program(Module) :-
    checking,
    prolog_load_context(source, File),
    \+ ( member(Folder, ['/pack/', '/swipl/']),
         sub_atom(File, 0, _, _, Folder) ),
    prolog_load_context(module, Module).

is_run(module(_, _)) :-
    !,
    fail.
is_run(Goal) :-
    (   predicate_property(system:Goal, built_in)
    ->  functor(Goal, Name, _),
        memberchk(Name, [(','), (;), (->), (*->), (\+), forall, findall])
    ;   Goal \= _:_
    ).

user:term_expansion(Term, Bounded) :-
    ev3dev_playground_check:bounded_directive(Term, Bounded).

:- public bounded/1.
:- meta_predicate bounded(0).

bounded(Goal) :-
    may_need(Most),
    call_with_inference_limit(Goal, Most, Within),
    (   Within == inference_limit_exceeded
    ->  assertz(endless),
        assertz(overdone(Most))
    ;   true
    ).

%   What ends a run is not for the program to catch.
:- multifile user:goal_expansion/2.
:- dynamic user:goal_expansion/2.

passes_end(Goal0, Goal) :-
    loads_program(Module),
    Goal0 =.. [Name, Called, Ball, Recovery],
    memberchk(Name, [catch, catch_with_backtrace]),
    Recovery \= ev3dev_playground_check:caught(_, _),
    Goal =.. [ Name, Called, Ball,
               ev3dev_playground_check:caught(Ball, Module:Recovery) ].

user:goal_expansion(Goal, Expanded) :-
    ev3dev_playground_check:passes_end(Goal, Expanded).

:- public caught/2.
:- meta_predicate caught(+, 0).

caught(Ball, _) :-
    ends_run(Ball),
    !,
    throw(Ball).
caught(_, Recovery) :-
    call(Recovery).

:- multifile ev3dev_watched_run:ends_run/1.

ev3dev_watched_run:ends_run(Ball) :-
    ev3dev_playground_check:ends_run(Ball).

ends_run(Ball) :-
    var(Ball),
    !,
    fail.
ends_run(ev3dev_over).
ends_run(inference_limit_exceeded).
ends_run(ev3dev_halt(_)).
ends_run('$aborted').
ends_run(unwind(abort)).
