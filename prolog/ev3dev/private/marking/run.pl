:- module(ev3dev_marking_run,
          [ marking_place/0,
            marking_exercise/2,         % +File, +Text
            marked_run/4                % +Files, +Which, +Enclosed, -Result
          ]).
:- use_module(read,
              [ exercise_happens/2, exercise_setting/3, exercise_world/3,
                read_exercise/2, score_shares/2, wrong_rule/2 ]).
:- use_module(explained, [lacks/3, watching/3]).
:- use_module(reasons, [reason_text/2, reasons/6]).
:- use_module(record,
              [record_end/3, recorded/4, run_fact/1, with_record/4]).
:- use_module(why, [collision_reason/1]).
:- use_module('../errors/message_text', [message_text/2]).
:- use_module('../batch/workplace', [end_workplace/1, new_workplace/2]).
:- use_module('../../sim', [with_sim/3]).
:- use_module('../../sim_fenced', [sim_fenced/3]).
:- use_module(library(filesex),
              [directory_file_path/3, make_directory_path/1]).
:- use_module(library(lists), [append/2, member/2]).
:- use_module(library(readutil), [read_file_to_string/3]).

/** <module> One run of one program, in a process of the marker
*/

:- meta_predicate or_lost(0), silently(0).

:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

:- dynamic exercise/2.                  % Exercise, its text

%!  marking_place is det.
%
%   The file that calls this while it is loaded is in a place of the marker,
%   where its runs have theirs, too.

marking_place :-
    prolog_load_context(directory, Folder),
    Flag = tmp_dir,                     % 7.2.3 has no such flag
    set_prolog_flag(Flag, Folder).

%!  marking_exercise(+File, +Text) is det.
%
%   The exercise in File. A machine that has no such file, or another one,
%   takes its Text.

marking_exercise(File, Text) :-
    (   exists_file(File),
        read_file_to_string(File, Text, [encoding(utf8)])
    ->  Path = File
    ;   tmp_file(ev3dev_exercise, Base),
        atom_concat(Base, '.pl', Path),
        write_text(Path, utf8, Text)
    ),
    silently(read_exercise(Path, Exercise)),
    retractall(exercise(_, _)),
    assertz(exercise(Exercise, Text)).

%   The marker has printed its warnings.

silently(Goal) :-
    setup_call_cleanup(
        asserta((user:message_hook(_, warning, _) :- true), Hook),
        once(Goal),
        erase(Hook)).

%!  marked_run(+Files, +Which, +Enclosed, -Result) is det.
%
%   Run a program. Files are Path-Text, of which the first begins. Which is a
%   seed, or watched(Seed): then the reason for what the run lacks is looked
%   for, too, and is a list of lines. Result is
%   result(Ended, Seconds, Shares, Reason, Collision, Film, Ways, Collisions):
%   the share of each score, a text of what went wrong or '', and one of how
%   it ran into something, or ''; Film and Ways are as of recorded/4. Whatever
%   the program leaves or breaks, so that nothing can be said of it, ends this
%   run alone: it is lost.
%
%   @error what is wrong with the exercise

marked_run(Files, Which, Enclosed, Result) :-
    catch(run_of(Files, Which, Enclosed, Result), lost_run(Error),
          ( message_text(Error, Why0),
            atom_concat('This run was lost: ', Why0, Why),
            Result = result(lost, 0, none, Why, '', [], [], []) )).

or_lost(Goal) :-
    catch(Goal, error(Formal, Context),
          (   Formal = existence_error(program, _)
          ->  throw(error(Formal, Context))
          ;   throw(lost_run(error(Formal, Context)))
          )).

run_of(Files, Which, Enclosed, Result) :-
    exercise(Exercise, Salt),
    exercise_setting(Exercise, goal(Goal0), start),
    exercise_setting(Exercise, seconds(Seconds), 60),
    (   Which = watched(Seed)
    ->  watching(Seconds, Goal0, Goal)
    ;   Seed = Which,
        Goal = Goal0
    ),
    fenced_run(Exercise-Salt, Files, Goal, Seed, Enclosed,
               ended(Ended, Output, File)),
    exercise_setting(Exercise, cpu(Cpu), 10),
    exercise_setting(Exercise, sleep(Sleep), 30),
    recorded(Film, Ways, Collisions, Took),
    reasons(Ended, Output, File, limits(Cpu, Sleep), Took, Reasons),
    (   Took > 0,
        memberchk(Ended, [over, exit(_)])
    ->  score_shares(Exercise, Shares)
    ;   Shares = none
    ),
    use_of_robot(Took, Shares, Use),
    (   Which = watched(_)
    ->  found_out(Reasons, Use, Exercise, Files, Shares, Reason)
    ;   Reasons = reasons([End|_], _, Hints)
    ->  reason_text([End|Hints], Reason)
    ;   reason_text(Use, Reason)
    ),
    (   collision_reason(Collision)
    ->  true
    ;   Collision = ''
    ),
    Result = result(Ended, Took, Shares, Reason, Collision, Film, Ways,
                    Collisions).

use_of_robot(Took, Shares, Use) :-
    (   Took =:= 0
    ->  Use = ['It did not use the robot.']
    ;   is_list(Shares),
        run_fact(commands(0)),
        member(Share, Shares),
        Share < 1
    ->  Use = ['It started no motor.']
    ;   Use = []
    ).

%   What a run lacks that ended as it should, and in which nothing is wrong.

found_out(reasons(Ends, Whys0, Hints), Use, Exercise, Files, Shares,
          Lines) :-
    exercise_setting(Exercise, seconds(Seconds), 60),
    findall(Why, ( member(Why0, Whys0), under_way(Why0, Seconds, Why) ),
            Whys),
    (   Ends-Whys == []-[]
    ->  (   is_list(Shares),
            Use == []
        ->  lacks(Exercise, Files, Lacks)
        ;   Lacks = Use
        )
    ;   Lacks = []
    ),
    append([Ends, Whys, Hints, Lacks], Lines).

under_way(Why0, Seconds, Why) :-
    (   sub_atom(Why0, _, _, _, 'calls itself without end: '),
        \+ sub_atom(Why0, _, _, _, 'the stack')
    ->  format(atom(Why), 'It was still under way after ~w s: ~w',
               [Seconds, Why0])
    ;   Why = Why0
    ).

%   fenced_run(+Marking, +Files, +Goal, +Seed, +Enclosed, -Ended):
%   run the program Files, which begins with Goal, and record it. Marking is
%   Exercise-Salt; Ended is ended(How, Output, File).

fenced_run(Exercise-Salt, [Name-Text|Others], Goal, Seed, Enclosed,
           ended(Ended, Output, File)) :-
    exercise_world(Exercise, Seed, World),
    exercise_setting(Exercise, seconds(Seconds), 60),
    exercise_setting(Exercise, noise(Noise), false),
    exercise_setting(Exercise, robot(Robot), default),
    exercise_setting(Exercise, cpu(Cpu), 10),
    exercise_setting(Exercise, sleep(Sleep), 30),
    exercise_setting(Exercise, memory(Memory), 2000),
    exercise_setting(Exercise, thinking(Thinking), free),
    Options = [ goal(Goal), seconds(Seconds), cpu(Cpu), sleep(Sleep),
                memory(Memory), enclosed(Enclosed), files(Beside),
                output(Output), told(Lines), salt(Salt),
                thinking(Thinking) ],
    setup_call_cleanup(
        or_lost(new_workplace(ev3dev_mark, Directory)),
        ( directory_file_path(Directory, Name, File),
          findall(Other,
                  ( member(Path-_, Others),
                    directory_file_path(Directory, Path, Other) ),
                  Beside),
          forall(member(Path-Bytes, [Name-Text|Others]),
                 or_lost(write_program(Directory, Path, Bytes))),
          catch(
              with_sim(World,
                  ( exercise_happens(Exercise, Seed),
                    with_record(or_lost(sim_fenced(File, Ended, Options)),
                                Seed, World, Robot),
                    record_end(Ended, Output, Lines) ),
                  [ clock(virtual), seed(Seed), noise(Noise),
                    robot(Robot) ]),
              error(Formal, Context),
              wrong_world(Exercise, Seed, World, error(Formal, Context))) ),
        end_workplace(Directory)).

%   If the world alone has an error, it is the exercise's rule that is wrong.

wrong_world(exercise(Module, _, _, _), Seed, World, Error) :-
    catch(with_sim(World, true, [clock(virtual)]), error(Formal, Context),
          true),
    (   nonvar(Formal),
        Context = context(_, Text0)
    ->  (   Formal = domain_error(_, Fact)
        ->  format(atom(Text), '~q: ~w', [Fact, Text0])
        ;   Text = Text0
        ),
        wrong_rule(Module:world(Seed, _), Text)
    ;   throw(Error)
    ).

write_program(Directory, Path, Bytes) :-
    directory_file_path(Directory, Path, File),
    file_directory_name(File, Folder),
    make_directory_path(Folder),
    write_text(File, octet, Bytes).

write_text(File, Encoding, Text) :-
    setup_call_cleanup(
        open(File, write, Out, [encoding(Encoding)]),
        write(Out, Text),
        close(Out)).
