:- module(golog_runs,
          [ runs/2,                     % +Program, -Runs
            runs/3,                     % +Program, +History, -Runs
            steps/2,                    % +Program, -Steps
            steps/3,                    % +Program, +History, -Steps
            lab_final/1,                % +Program
            answers/4,                  % ?Template, +Condition, +History,
                                        % -Answers
            true_in/2,                  % +Condition, +History
            with_domain/3,              % +Clauses, -Module, :Goal
            online/3,                   % +Program, +Options, -Run
            said/2,                     % :Goal, -Texts
            said_of_all/2               % :Goal, -Kinds
          ]).
:- use_module(library(ev3dev/golog)).
:- use_module(lab).

/** <module> Runs of programs, for the tests of library(ev3dev/golog)
*/

:- meta_predicate
    with_domain(+, -, 0),
    said(0, -),
    said_of_all(0, -).

:- dynamic said_text/1.

%!  runs(+Program, -Runs) is det.
%!  runs(+Program, +History, -Runs) is det.
%
%   Every History to which Program runs offline, oldest action first.

runs(Program, Runs) :-
    runs(Program, [], Runs).

runs(Program, H0, Runs) :-
    findall(Run,
            ( golog_lab:do(Program, H0, H), reverse(H, Run) ),
            Runs).

%!  steps(+Program, -Steps) is det.
%!  steps(+Program, +History, -Steps) is det.
%
%   Every step that Program can take.

steps(Program, Steps) :-
    steps(Program, [], Steps).

steps(Program, H0, Steps) :-
    findall(E-H, golog_lab:trans(Program, H0, E, H), Steps).

%!  lab_final(+Program) is semidet.

lab_final(Program) :-
    golog_lab:final(Program, []).

%!  answers(?Template, +Condition, +History, -Answers) is det.
%
%   All instances of Template for which Condition holds after History.

answers(Template, Condition, H, Answers) :-
    findall(Template, golog_lab:holds(Condition, H), Answers).

%!  true_in(+Condition, +History) is nondet.

true_in(Condition, H) :-
    golog_lab:holds(Condition, H).

%!  with_domain(+Clauses, -Module, :Goal)
%
%   Call Goal with a module that has the domain Clauses.

with_domain(Clauses, Module, Goal) :-
    flag(golog_test, N, N+1),
    atom_concat(golog_test_, N, Module),
    add_import_module(Module, user, start),
    forall(member(Clause, Clauses), assertz(Module:Clause)),
    call(Goal).

%!  online(+Program, +Options, -Run) is det.
%
%   Run Program of the lab; Run is its history, oldest first.

online(Program, Options, Run) :-
    golog_lab:executed(_),
    retractall(golog_lab:next_exog(_)),
    golog_lab:golog(Program, [history(H)|Options]),
    reverse(H, Run).

%!  said(:Goal, -Texts) is semidet.
%
%   Call Goal; Texts are what Golog prints meanwhile, in any thread.

said(Goal, Texts) :-
    retractall(said_text(_)),
    setup_call_cleanup(
        asserta((user:thread_message_hook(Term, _, Lines) :-
                     golog_runs:keep(Term, Lines)), Ref),
        call(Goal),
        erase(Ref)),
    findall(Text, retract(said_text(Text)), Texts).

keep(golog(_), Lines) :-
    with_output_to(atom(Text), print_message_lines(current_output, '', Lines)),
    assertz(said_text(Text)).

%!  said_of_all(:Goal, -Kinds) is semidet.
%
%   Call Goal; Kinds has `warning` or `error` for each such message.

said_of_all(Goal, Kinds) :-
    retractall(said_text(_)),
    setup_call_cleanup(
        asserta((user:message_hook(_, Kind, _) :-
                     memberchk(Kind, [warning, error]),
                     assertz(golog_runs:said_text(Kind))), Ref),
        call(Goal),
        erase(Ref)),
    findall(Kind, retract(said_text(Kind)), Kinds).
