:- module(compared,
          [ compared_events/3           % +Seed, -Recorded, -Interpreted
          ]).
:- use_module(library(assoc)).
:- use_module(meta_interpreter).
:- use_module(random_programs).
:- use_module('../../../prolog/ev3dev/private/reasoning/events').
:- use_module('../../../prolog/ev3dev/private/reasoning/instrument').
:- use_module('../../../prolog/ev3dev/private/reasoning/recorder').

/** <module> A random program, recorded and interpreted

Both lists have the same form: nodes are numbered by their calls, an attempt
that found nothing at once is left out, and errors have no context.
*/

:- dynamic user:rp_d/1.

%!  compared_events(+Seed, -Recorded, -Interpreted) is semidet.
%
%   Fails if the program does too much, or makes a cyclic term.

compared_events(Seed, Recorded, Interpreted) :-
    random_program(Seed, Clauses),
    tmp_file(program, Base),
    atom_concat(Base, '.pl', File),
    setup_call_cleanup(
        write_program(File, Clauses),
        ( load_files(user:File, [silent(true)]),
          both(File, Recorded, Interpreted) ),
        ( unload_file(File), delete_file(File) )).

write_program(File, Clauses) :-
    setup_call_cleanup(
        open(File, write, Out),
        ( forall(member(Check, [singleton, discontiguous, no_effect,
                                var_branches]),
                 format(Out, ':- style_check(-~w).~n', [Check])),
          forall(member(Clause, Clauses), write_clause(Out, Clause)) ),
        close(Out)).

write_clause(Out, Clause0) :-
    copy_term(Clause0, Clause),
    numbervars(Clause, 0, _),
    write_term(Out, Clause, [quoted(true), numbervars(true)]),
    write(Out, '.\n').

both(File, Recorded, Interpreted) :-
    read_program(File),
    facts_again,
    catch(meta_events(rp0(_), Events), too_long, fail),
    without_empty(Events, [], Interpreted0),
    maplist(plain, Interpreted0, Interpreted),
    facts_again,
    catch(forall(record(user:rp0(_), 32000000), true), _, true),
    events(Events1),
    findall(Node, member(e(call, Node, _, _), Events1), Nodes),
    numbered(Nodes, 1, Pairs),
    list_to_assoc([0-0|Pairs], Numbers),
    findall(Event,
            ( member(e(Port, Node, Data, _), Events1),
              interpreted(Port, Node, Data, Numbers, Event) ),
            Recorded).

facts_again :-
    retractall(user:rp_d(_)),
    assertz(user:rp_d(a)),
    assertz(user:rp_d(1)).

numbered([], _, []).
numbered([Node|Nodes], N, [Node-N|Pairs]) :-
    N1 is N+1,
    numbered(Nodes, N1, Pairs).

without_empty([], Reversed, Events) :-
    reverse(Reversed, Events).
without_empty([Event|Events0], Reversed, Events) :-
    (   Event = fail(I),
        Reversed = [redo(I)|Reversed1]
    ->  true
    ;   Reversed1 = [Event|Reversed]
    ),
    without_empty(Events0, Reversed1, Events).

interpreted(call, Node, Parent-Goal, Numbers, Event) :-
    get_assoc(Node, Numbers, I),
    get_assoc(Parent, Numbers, P),
    plain(call(I, P, Goal), Event).
interpreted(Exit, Node, Goal, Numbers, Event) :-
    memberchk(Exit, [exit, more]),
    get_assoc(Node, Numbers, I),
    plain(exit(I, Goal), Event).
interpreted(unify, Node, Key, Numbers, unify(I, N)) :-
    get_assoc(Node, Numbers, I),
    clause_of(Key, place(_, N, _, _, _)).
interpreted(redo, Node, _, Numbers, redo(I)) :-
    get_assoc(Node, Numbers, I).
interpreted(fail, Node, _, Numbers, fail(I)) :-
    get_assoc(Node, Numbers, I).
interpreted(exception, Node, ball(Ball), Numbers, Event) :-
    get_assoc(Node, Numbers, I),
    plain(exception(I, Ball), Event).

plain(Event0, Event) :-
    Event0 =.. [Port|Arguments0],
    append(Numbers, [Term0], Arguments0),
    !,
    stripped(Term0, Term1),
    ev3dev_recorder:bounded(Term1, Term2, _),
    copy_term(Term2, Term),
    numbervars(Term, 0, _),
    append(Numbers, [Term], Arguments),
    Event =.. [Port|Arguments].

stripped(Term, Term) :-
    \+ compound(Term),
    !.
stripped(user:Term0, Term) :-
    !,
    stripped(Term0, Term).
stripped(error(Formal, _), error(Formal)) :- !.
stripped(Term0, Term) :-
    Term0 =.. [Name|Arguments0],
    maplist(stripped, Arguments0, Arguments),
    Term =.. [Name|Arguments].
