% Random calls of every public predicate, and of every native one, with terms that
% nobody expects: each succeeds, fails, or throws an error that names what was called.

:- use_module('../support/simulation').
:- use_module('../support/cases').
:- use_module('../support/child').
:- use_module('../support/odd_terms').

% ---------------- WHAT IS CALLED

:- dynamic library_file/1.

:- prolog_load_context(directory, Here),
   atomic_list_concat([Here, '/../../prolog/ev3dev/*.pl'], Pattern),
   expand_file_name(Pattern, Files),
   forall(member(File0, Files),
          ( absolute_file_name(File0, File),
            assertz(library_file(File)),
            file_base_name(File, Base),
            file_name_extension(Name, pl, Base),
            use_module(library(ev3dev/Name), []) )).

predicate(public, Module:Name/Arity) :-
    library_file(File),
    module_property(Module, file(File)),
    exported(Module, Name/Arity).
predicate(native, ev3dev_native:Name/Arity) :-
    exported(ev3dev_native, Name/Arity).

exported(Module, Name/Arity) :-
    module_property(Module, exports(Exports)),
    member(Name/Arity, Exports),
    Arity > 0,
    \+ left_out(Name).

% They wait for a person, for a goal, for an answer, or as long as asked; are for a session of
% its own; end the process; or take a map that grid_map/2 made.
left_out(jog).
left_out(button_wait).
left_out(view_visit_).
left_out(sensor_wait).
left_out(sim_step).
left_out(sim_step_).
left_out(ask_execute).
left_out(ask_exog_occurs).
left_out(halts_by_).
left_out(at_halt_).
left_out(sim_fence_join_).
left_out(Name) :-
    sub_atom(Name, 0, _, _, grid_).

% ---------------- A CALL

:- dynamic predicates/2.

:- forall(member(Kind, [public, native]),
          ( setof(Predicate, predicate(Kind, Predicate), Predicates),
            assertz(predicates(Kind, Predicates)) )).

call_of(Kind, Seed, Module:Goal) :-
    predicates(Kind, Predicates),
    set_random(seed(Seed)),
    random_member(Module:Name/Arity, Predicates),
    functor(Head, Name, Arity),
    (   predicate_property(Module:Head, meta_predicate(Meta))
    ->  true
    ;   Meta = Head
    ),
    Meta =.. [_|Modes],
    maplist(argument, Modes, Arguments),
    Goal =.. [Name|Arguments].

% A list is a goal of Prolog's: it loads files.
argument(Mode, Argument) :-
    repeat,
    (   maybe(0.05)
    ->  findall(Large, large(Large), Larges),
        random_member(Argument, Larges)
    ;   maybe(0.4)
    ->  findall(Odd, odd(Odd), Odds),
        random_member(Odd, Odds),
        within(Odd, Argument)
    ;   findall(Usual, usual(Usual), Usuals),
        random_member(Argument, Usuals)
    ),
    \+ ( integer(Mode),
         nonvar(Argument),
         Argument = [_|_] ),
    !.

within(Odd, Argument) :-
    random_member(Argument,
                  [ Odd, Odd, Odd, [Odd], [a, Odd], Odd-1, 1-Odd, Odd+1, [1-Odd],
                    [timeout(Odd)], motor_run(outB, Odd) ]).

usual(_).
usual(_).
usual(Term) :-
    member(Term,
           [ outA, outB, outC, in1, in2, in4, 0, 1, 50, 1.5, [], [a], true, fail, room,
             '/nowhere/file', "text", foo(bar), [1, 2], 1-2, [1-2, 3-4], red, left,
             enter, pressed, 'US-DIST-CM', position, stop, hold, speed, [wait(false)],
             [timeout(0.1)], [outB, outC], [run(outB, 5)], circle(10, 10, 5),
             us_dist_cm(in1, _), us_dist_cm(in1) < 20 ]).

wrong(Kind, Seed, Goal-Error) :-
    call_of(Kind, Seed, Goal),
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC),
               catch(call_with_time_limit(300,
                                          with_output_to(string(_), ignore(Goal))),
                     Error, true) )),
    nonvar(Error),
    thrown(Kind, Error),
    \+ may_throw(Kind, Goal, Error).

% ---------------- HOW PROLOG PRINTS WHAT IS THROWN

%   What another process can read, once.
:- dynamic was_thrown/1.

thrown(native, _).
thrown(public, Error) :-
    (   acyclic_term(Error),
        small(Error, 500, _),           % SWI-Prolog 7.2.3 writes a large one for minutes
        catch(( format(string(Text), "~k", [Error]), term_to_atom(_, Text) ), error(_, _), fail),
        \+ was_thrown(Text)
    ->  assertz(was_thrown(Text))
    ;   true
    ).

%   It has fewer than Limit subterms; the Left ones are for what stands beside it.
small(Term, Limit, Left) :-
    Limit > 0,
    Left0 is Limit-1,
    (   compound(Term)
    ->  compound_name_arguments(Term, _, Arguments),
        foldl(small, Arguments, Left0, Left)
    ;   Left = Left0
    ).

%   By a Prolog that knows nothing of the pack; each has a line, or several.
printed(Errors, Lines) :-
    findall(Fact, ( member(Error, Errors), format(string(Fact), "error(~q).", [Error]) ), Facts),
    atomic_list_concat([ "main :- error(Text), term_to_atom(E, Text),
                                 catch('$messages':translate_message(E, Lines, []), _, fail),
                                 print_message_lines(user_output, '', Lines), nl, fail.
                         main." | Facts], '\n', Text),
    run_program(Text, [goal(main)], exit(0), Output),
    split_string(Output, "\n", "", Lines).

may_throw(_, _, Error) :-
    of_its_goal(Error).
may_throw(public, _:Goal, error(Formal, context(Called, Message))) :-
    nonvar(Formal),
    (   Calls = Goal
    ;   arg(_, Goal, Argument),         % a goal that it called
        ( Calls = Argument ; is_list(Argument), member(Calls, Argument) )
    ),
    callable(Calls),
    called(Calls, Called),
    !,
    (   Formal == resource_error(c_stack)       % its words are Prolog's
    ->  true
    ;   atom(Message),
        atom_length(Message, Length),
        Length < 12000
    ).
may_throw(public, _, error(_, fact(file(_), _))).
may_throw(public, _, error(syntax_error(_), file(_, _, _, _))).
may_throw(native, _, error(Formal, _)) :-
    nonvar(Formal),
    Formal \= rust_error(_).

called(Goal, Called) :-
    compound(Goal),
    !,
    compound_name_arity(Goal, Name, Arity),     % functor/3 refuses wall()
    Called == Name/Arity.
called(Name, Called) :-
    Called == Name/0.

of_its_goal(error(existence_error(procedure, _), _)).
of_its_goal(error(representation_error(max_procedure_arity), _)).
of_its_goal(time_limit_exceeded).      % it waits as long as it is asked to
of_its_goal(error(format(_), _)).
% Half a pair of UTF-16 cannot be written.
of_its_goal(error(representation_error(code_point), context(system:format/3, _))).
% us_dist_cm(in1) < 20, where no condition is meant, is Prolog's comparison
of_its_goal(error(type_error(evaluable, in1/0), context(system:(<)/2, _))).

% ---------------- TESTS

% What writes a file does so in a directory of its own.
all_wrong(Kind, Wrongs) :-
    schedules(First, Last),
    tmp_file(odd, Directory),
    working_directory(Before, Before),
    setup_call_cleanup(
        ( make_directory(Directory), working_directory(_, Directory) ),
        findall(Seed:Wrong,
                ( between(First, Last, Seed), once(wrong(Kind, Seed, Term)),
                  format(string(Wrong), "~W", [Term, [quoted(true), max_depth(12)]]) ),
                Wrongs),
        ( working_directory(_, Before), delete_directory_and_contents(Directory) )).

:- begin_tests(odd_terms, [ setup(silent(true)), cleanup(silent(false)) ]).
test(what_is_left_out_is_there, true(Gone == [])) :-
    findall(Name,
            ( clause(left_out(Name), true),
              \+ ( current_module(Module),
                   sub_atom(Module, 0, _, _, ev3dev),
                   module_property(Module, exports(Exports)),
                   memberchk(Name/_, Exports) ) ),
            Gone).
% Goals of threads print their errors.
silent(true) :-
    asserta((user:message_hook(Message, _, _) :- Message \= plunit(_), !)).
silent(false) :-
    retract((user:message_hook(_, _, _) :- _, !)).

test(are_no_reason_for_what_is_no_iso_error, true(Wrongs == [])) :-
    all_wrong(public, Wrongs).
%   Of those above, and of what is wrong with the pack's own words.
test(are_printed_by_any_prolog, true(Raw == [])) :-
    findall(Error, was_thrown(Error), Errors),
    Errors = [_|_],
    printed(Errors, Lines),
    findall(Line, ( member(Line, Lines), is_raw(Line) ), Raw).
test(what_is_raw_is_seen, true(Seen == Lines)) :-
    printed(["error(foo(x),bar)", "error(type_error(dict,context(c/1,b)),context(p/1,'x'))"], All),
    exclude(==(""), All, Lines),
    include(is_raw, Lines, Seen).

is_raw(Line) :-
    member(Part, ["Unknown error", "Unknown message", "context(", "`dict\' expected"]),
    sub_string(Line, _, _, _, Part).

test(are_no_reason_for_a_panic, true(Wrongs == [])) :-
    all_wrong(native, Wrongs).
:- end_tests(odd_terms).
