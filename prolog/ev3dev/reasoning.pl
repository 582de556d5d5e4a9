:- module(ev3dev_reasoning,
          [ reasoning/1,                % :Goal
            reasoning/2,                % :Goal, +Options
            reasoning_text/0,
            reasoning_text/1            % ?Text
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(library(lists), [member/2]).
:- use_module(private/checks/arguments,
              [must_be_options/3, number_option/4, word/2]).
:- use_module(private/checks/checks, [must_be_goal/1]).
:- use_module(private/errors/errors, [throw_error/3]).
:- use_module(private/errors/frames, [goal_of_program/1]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/queries, [calls/2]).
:- use_module(private/files/directory, [write_file/2]).
:- use_module(private/reasoning/outline, [episodes/1]).
:- use_module(private/reasoning/reasoning_page, []).
:- use_module(private/reasoning/reasoning_words, [reasoning_lines/1]).
:- use_module(private/reasoning/recorder, [record/2, recorded_goal/1]).
:- use_module(private/reasoning/why_false, [why_false/2]).

:- meta_predicate
    reasoning(0),
    reasoning(0, +).

/** <module> See Prolog think

Shows what Prolog tries, what fails, and where it goes back, beside what the
robot does. Prolog takes a binding back; a robot that has moved stays where it
is.

```
?- reasoning(start).
false.
?- reasoning_text.
```

The record has the goals in the clauses of the program's own files, and not
what a predicate of the pack or of Prolog does inside, except goals of the
program that it calls. Other threads are not recorded. The program does what
it does without a recorder; it takes up to ten times as long to compute, also
by thinking(brick) of sim_start/2. docs/reasoning.md is a lesson with it.
*/

%!  reasoning(:Goal) is nondet.
%!  reasoning(:Goal, +Options) is nondet.
%
%   Call Goal, and record what happens. It has the answers of Goal, and its
%   errors. What was recorded before is forgotten; a reasoning/1 in the Goal
%   of another one is a part of that record. If Goal fails at the prompt, a
%   sentence says why.
%
%   Options:
%
%     - megabytes(+Number)
%       The size of the record, 32 by default. If it is full, the first
%       quarter stays, and of what follows the latest events.
%
%   Calls deeper than 30000 run, and are not recorded.
%
%   @error instantiation_error if Goal is unbound
%   @error type_error(callable, Goal)
%   @error domain_error(reasoning_option, Option)
%   @error permission_error(record, goal, Goal) while another thread records
%   @error permission_error(access, private_procedure, Name/Arity) if the flag
%          `protect_static_code` hides the clauses of the program

reasoning(Goal) :-
    reasoning(Goal, []).

reasoning(Goal, Options) :-
    must_be_goal(Goal),
    must_be_options(reasoning_option, [megabytes], Options),
    number_option(megabytes(Megabytes), positive_number, Options, 32),
    (   nb_current(ev3dev_reasoning, Node),
        Node \== []
    ->  goal_of_program(Goal)
    ;   Bytes is Megabytes*1000000,
        record(Goal, Bytes)
    ).

%!  reasoning_text is det.
%!  reasoning_text(?Text) is det.
%
%   Print the record of the last reasoning/1; if Text is unbound, it becomes
%   a string with it; else Text is a file, which is written. Each row is a
%   call: the simulated time in seconds, `+` if it is true and `-` if it is
%   false, the goal, and where its clause is. If there were several answers
%   (`?`), each has a number, and what followed it is below. Rows that do the
%   same are counted.
%
%   @error existence_error(reasoning, record) if nothing is recorded
%   @error the errors of open/4

reasoning_text :-
    lines(Lines),
    write_lines(Lines, current_output).

reasoning_text(Text) :-
    lines(Lines),
    (   var(Text)
    ->  with_output_to(string(Text), write_lines(Lines, current_output))
    ;   word(Text, File),
        write_file(File, ev3dev_reasoning:write_lines(Lines))
    ).

lines(Lines) :-
    (   recorded_goal(_)
    ->  reasoning_lines(Lines)
    ;   throw_error(existence_error(reasoning, record), _,
                    'nothing is recorded: reasoning/1 records a goal')
    ).

write_lines(Lines, Out0) :-
    (   Out0 == current_output
    ->  current_output(Out)
    ;   Out = Out0
    ),
    forall(member(Line, Lines), format(Out, '~w~n', [Line])).

% ---------------- AT THE PROMPT

:- multifile
    ev3dev_queries:why_failed/2,
    prolog:message//1.
:- dynamic ev3dev_queries:why_failed/2.

ev3dev_queries:why_failed(Query, Message) :-
    ev3dev_reasoning:why_failed(Query, Message).

why_failed(Query, ev3dev(why_false(Sentences))) :-
    calls(Query, Goal),
    functor(Goal, reasoning, _),
    !,
    episodes(Episodes),
    why_false(Episodes, Sentences).

prolog:message(ev3dev(why_false(Sentences))) -->
    sentences(Sentences),
    [ '`reasoning_text.` prints every step'-[] ].

sentences([]) -->
    [].
sentences([Sentence|Sentences]) -->
    [ '~w'-[Sentence], nl ],
    sentences(Sentences).
