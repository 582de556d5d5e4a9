:- module(ev3dev_marking_read,
          [ read_exercise/2,            % +File, -Exercise
            exercise_fact/2,            % ?Name, ?Arity
            exercise_setting/3,         % +Exercise, ?Setting, +Default
            exercise_seeds/3,           % +Exercise, +Which, -Seeds
            seed_list/2,                % +Seeds, -List
            exercise_world/3,           % +Exercise, +Seed, -World
            exercise_happens/2,         % +Exercise, +Seed
            score_shares/2,             % +Exercise, -Shares
            forbidden/3,                % +Exercise, +Terms, -Reason
            wrong/2,                    % +What, +Message
            wrong_rule/2,               % +Rule, +Text
            program_terms/2             % +Text, -Terms
          ]).
:- use_module('../errors/error_texts', [clause_place/2, place_first/2]).
:- use_module('../errors/errors', [in_own_name/1, throw_error/3]).
:- use_module('../errors/message_text', [message_text/2]).
:- use_module('../simulation/thinking_rate', [thinking_rate/2]).
:- use_module(library(lists),
              [append/3, member/2, numlist/3]).

:- meta_predicate in_rule(+, 0).

% The operators of library(ev3dev/rules)
:- op(1160, xfx, ::).
:- op(1150, xfx, ~>).

/** <module> Exercises and programs, as files

An exercise is exercise(Module, Name, Options, Scores): the module into which
its file was loaded, and score(Points, Text, Head, Share) for each score, in
the order of the file. A program is only read, never run.
*/

:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

:- dynamic load_error/1.

%!  read_exercise(+File, -Exercise) is det.
%
%   @error domain_error(exercise, What) with a sentence, as if File, or a file
%          that it loads, has errors; each of these is printed

read_exercise(File, exercise(Module, Name, Options, Scores)) :-
    atom_concat('exercise:', File, Module),
    Module:discontiguous([score/2, score/3]),
    % When it is read again, that declaration is forgotten.
    setup_call_cleanup(
        style_check(-(discontiguous)),
        loaded(Module:File, Errors),
        style_check(+(discontiguous))),
    (   Errors == []
    ->  true
    ;   file_base_name(File, Loaded),
        format(atom(Broken), '~w does not load without errors: \c
                              correct them first', [Loaded]),
        wrong(File, Broken)
    ),
    findall(Found-Its,
            ( current_predicate(Module:exercise/2),
              call(Module:exercise(Found, Its)) ),
            Exercises),
    (   Exercises = [Name-Options]
    ->  true
    ;   file_base_name(File, Base),
        format(atom(Says), '~w is no exercise: it has no fact \c
                            exercise(Name, Options), or several', [Base]),
        wrong(File, Says)
    ),
    (   is_list(Options),
        member(Old, Options),
        nonvar(Old),
        Old = wall(Seconds)
    ->  wrong(wall(Seconds), 'this limit is called sleep(Seconds) now')
    ;   \+ is_list(Options)
    ->  wrong(Options, 'its options are no list')
    ;   member(Option, Options),
        \+ ( nonvar(Option), good(Option) )
    ->  wrong_option(Option, Options)
    ;   true
    ),
    findall(Line-score(Points, Text, Head, Share),
            a_score(Module, Line, Points, Text, Head, Share), Found0),
    keysort(Found0, Found1),
    findall(Score, member(_-Score, Found1), Scores),
    (   Scores == []
    ->  wrong(File, 'it has no score/2 nor score/3')
    ;   member(score(Points, Text, _, _), Scores),
        \+ ( number(Points), Points > 0, atomic(Text) )
    ->  wrong(score(Points, Text), 'points are numbers above 0')
    ;   true
    ).

%   Errors has an `x` for each error that was printed meanwhile.

loaded(Exercise, Errors) :-
    retractall(load_error(_)),
    setup_call_cleanup(
        asserta((user:message_hook(_, error, _) :-
                     assertz(ev3dev_marking_read:load_error(x)),
                     fail),
                Hook),
        in_own_name(load_files(Exercise, [if(true), silent(true)])),
        erase(Hook)),
    findall(Error, retract(load_error(Error)), Errors).

%!  wrong(+What, +Message)
%
%   Throws domain_error(exercise, What).

wrong(What, Message) :-
    throw_error(domain_error(exercise, What), _, Message).

wrong_option(Option, Options) :-
    (   callable(Option),
        functor(Option, Name, 1),
        functor(Known, Name, 1),
        clause(good(Known), _)
    ->  format(atom(Text), 'the value of the option ~q makes no sense',
               [Option]),
        wrong(Options, Text)
    ;   findall(Name,
                ( clause(good(Known), _), functor(Known, Name, 1) ), Names),
        wrong(Options, one_of(Option, Names))
    ).

good(goal(Goal)) :- callable(Goal).
good(seconds(N)) :- number(N), N > 0.
good(seeds(Seeds)) :- seed_list(Seeds, _).
good(open(Seeds)) :- seed_list(Seeds, _).
good(robot(Robot)) :- nonvar(Robot).
good(thinking(Thinking)) :-
    nonvar(Thinking),
    catch(thinking_rate([thinking(Thinking)], _), error(_, _), fail).
good(noise(Boolean)) :- memberchk(Boolean, [true, false]).
good(cpu(N)) :- number(N), N > 0.
good(sleep(N)) :- number(N), N > 0.
good(memory(N)) :- integer(N), N > 0.
good(solution(File)) :- atomic(File).

a_score(Module, Line, Points, Text, Module:Head, Share) :-
    (   Head = score(Points, Text),
        Share = 1
    ;   Head = score(partial(Points), Text, Share)
    ),
    functor(Head, score, Arity),
    current_predicate(Module:score/Arity),
    clause(Module:Head, _, Clause),
    (   clause_property(Clause, line_count(Line))
    ->  true
    ;   Line = 0
    ).

%!  exercise_fact(?Name, ?Arity) is nondet.
%
%   What this file asks an exercise for.

exercise_fact(exercise, 2).
exercise_fact(world, 2).
exercise_fact(score, 2).
exercise_fact(score, 3).
exercise_fact(happens, 1).
exercise_fact(forbid, 1).

%!  exercise_setting(+Exercise, ?Setting, +Default) is det.
%
%   Setting is Name(Value), of the options of exercise/2.

exercise_setting(exercise(_, _, Options, _), Setting, Default) :-
    (   memberchk(Setting, Options)
    ->  true
    ;   arg(1, Setting, Default)
    ).

%!  exercise_seeds(+Exercise, +Which, -Seeds) is det.
%
%   Seeds are all of them for `all`, those that students may see for `open`.

exercise_seeds(Exercise, Which, Seeds) :-
    exercise_setting(Exercise, seeds(Given), 1-10),
    seed_list(Given, All),
    exercise_setting(Exercise, open(Open), first),
    (   Which == all
    ->  Seeds = All
    ;   Open \== first
    ->  seed_list(Open, Seeds)
    ;   append([A, B, C], _, All)
    ->  Seeds = [A, B, C]
    ;   Seeds = All
    ).

%!  seed_list(+Seeds, -List) is semidet.
%
%   Seeds is From-To, an integer, or a list of integers.

seed_list(From-To, Seeds) :-
    integer(From),
    integer(To),
    From =< To,
    !,
    numlist(From, To, Seeds).
seed_list(Seed, [Seed]) :-
    integer(Seed),
    !.
seed_list([Seed|Seeds], [Seed|Seeds]) :-
    \+ ( member(One, [Seed|Seeds]), \+ integer(One) ).

%!  exercise_world(+Exercise, +Seed, -World) is det.
%
%   @error domain_error(exercise, What)

exercise_world(exercise(Module, _, _, _), Seed, World) :-
    (   \+ current_predicate(Module:world/2)
    ->  World = room
    ;   Rule = Module:world(Seed, World),
        in_rule(Rule, Rule)
    ->  true
    ;   wrong(world(Seed, _), 'it has no world for this seed')
    ).

%!  exercise_happens(+Exercise, +Seed) is det.
%
%   Plan what is to happen in a run that begins.

exercise_happens(exercise(Module, _, _, _), Seed) :-
    (   current_predicate(Module:happens/1)
    ->  Rule = Module:happens(Seed),
        ignore(in_rule(Rule, Rule))
    ;   true
    ).

%!  score_shares(+Exercise, -Shares) is det.
%
%   The shares, from 0 to 1, of the scores of the run that is recorded. An
%   error in a score goes through, with its line.

score_shares(exercise(_, _, _, Scores), Shares) :-
    shares(Scores, Shares).

shares([], []).
shares([score(_, _, Head, Share)|Scores], [Earned|Shares]) :-
    copy_term(Head-Share, Goal-Found),
    in_rule(Goal,
            (   call(Goal)
            ->  Earned is max(0, min(1, Found))
            ;   Earned = 0
            )),
    shares(Scores, Shares).

%   An error in a rule of the exercise says at which line the rule is.

in_rule(Rule, Goal) :-
    catch(Goal, error(Formal, Context),
          ( message_text(error(Formal, Context), Text),
            wrong_rule(Rule, Text) )).

%!  wrong_rule(+Rule, +Text)
%
%   Throws domain_error(exercise, Head) with Text, after the file and the line
%   of the first clause for Rule, which is Module:Head.

wrong_rule(Module:Head, Text) :-
    (   clause(Module:Head, _, Clause)
    ->  clause_place(Clause, Place)
    ;   Place = none
    ),
    place_first(Place, At),
    atom_concat(At, Text, Message),
    wrong(Head, Message).

%!  forbidden(+Exercise, +Terms, -Reason) is semidet.
%
%   A program of these terms mentions what the exercise forbids.

forbidden(exercise(Module, _, _, _), Terms, Reason) :-
    current_predicate(Module:forbid/1),
    member(term(Term, Line), Terms),
    call(Module:forbid(Name/Arity)),
    mentions(Term, Name, Arity),
    !,
    format(atom(Reason), 'Line ~d: ~w/~w may not be used here.',
           [Line, Name, Arity]).

mentions(Term, Name, Arity) :-
    nonvar(Term),
    (   functor(Term, Name, Arity)
    ->  true
    ;   compound(Term),
        Term =.. [_|Arguments],
        member(Argument, Arguments),
        mentions(Argument, Name, Arity)
    ),
    !.

%!  program_terms(+Text, -Terms) is det.
%
%   The terms of a program, as term(Term, Line). What is not a term is left
%   out.

program_terms(Text, Terms) :-
    setup_call_cleanup(
        open_string(Text, In),
        terms(In, Terms),
        close(In)).

terms(In, Terms) :-
    catch(read_term(In, Term, [ syntax_errors(quiet), term_position(Position),
                                module(ev3dev_marking_read) ]), _, fail),
    !,
    (   Term == end_of_file
    ->  Terms = []
    ;   stream_position_data(line_count, Position, Line),
        Terms = [term(Term, Line)|Terms1],
        terms(In, Terms1)
    ).
terms(In, Terms) :-
    (   at_end_of_stream(In)
    ->  Terms = []
    ;   terms(In, Terms)
    ).
