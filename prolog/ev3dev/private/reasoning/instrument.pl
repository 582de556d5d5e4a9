:- module(ev3dev_instrument,
          [ instrument/0,
            translate/4,                % +Goal, +Module, +Node, -Recorded
            clause_of/2,                % ?Key, ?Place
            named_body/3                % ?Key, -Body, -Names
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module('../basics/small_lists', [append_lists/3, one_of/2]).
:- use_module('../errors/frames', [in_pack/3, program/1]).

/** <module> The clauses of a program, compiled once more for the recorder

Each clause of the program's files gets a twin, whose goals note what happens
to them (recorder.pl). The twins are in the module ev3dev_recorded; the last
argument is the node of the call. The program's own clauses stay as they are,
so a program that is not recorded costs nothing more.

The clauses are those that Prolog has loaded, so term expansion, DCG and
conditions of compilation are done already. But the compiler rewrites goals:
`N-1` becomes `N + -1`, and some unifications vanish. So the file is read,
too, and if its text compiles to the same clause, the text is used.
*/

:- dynamic
    twin/3,                             % Head, Module, Twin
    kind_/4,                            % Name, Arity, Module, Kind
    clause_of/2,
    named_body/3,                       % Key, Body, Names
    text/4.                             % File, Line, Clause, Names
:- volatile
    twin/3,
    kind_/4,
    clause_of/2,
    named_body/3,
    text/4.

%!  instrument is det.
%!  clause_of(?Key, ?Place) is nondet.
%!  named_body(?Key, -Body, -Names) is semidet.
%
%   Make the twins of all clauses in the files of the program. Each has a Key.
%   Place is place(Predicate, Nth, Of, File, Line) of a clause: File is `none`
%   if it has no file. Body is as the file has it, with Names as of
%   read_term/2.
%
%   @error permission_error(access, private_procedure, Name/Arity) if the flag
%          `protect_static_code` hides the clauses

instrument :-
    forall(retract(twin(_, _, Twin)),
           ( functor(Twin, Name, Arity),
             functor(Head, Name, Arity),
             retractall(ev3dev_recorded:Head) )),
    retractall(kind_(_Name, _, _, _)),
    retractall(clause_of(_, _)),
    retractall(named_body(_, _, _)),
    forall(( program(File), source_file(Module:Head, File),
             is_recorded(Module:Head) ),
           add_twin(Module, Head)),
    forall(twin(Head, Module, _),
           forall(nth_clause(Module:Head, Nth, Clause),
                  add_clause(Module:Head, Nth, Clause))),
    retractall(text(_File, _, _, _)).

is_recorded(Module:Head) :-
    \+ predicate_property(Module:Head, dynamic),
    \+ in_pack(Module:x/0, _, _),
    \+ ( predicate_property(Module:Head, transparent),
         \+ predicate_property(Module:Head, meta_predicate(_)) ).

add_twin(Module, Head) :-
    (   twin(Head, Module, _)
    ->  true
    ;   Head =.. [Name|Arguments],
        atomic_list_concat([Module, :, Name], TwinName),
        append_lists(Arguments, [_Node], TwinArguments),
        Twin =.. [TwinName|TwinArguments],
        assertz(twin(Head, Module, Twin)),
        functor(Twin, _, Arity),
        dynamic(ev3dev_recorded:TwinName/Arity)
    ).

add_clause(Module:Head0, Nth, Clause) :-
    functor(Head0, Name, Arity),
    functor(Head1, Name, Arity),
    clause(Module:Head1, Body1, Clause),
    predicate_property(Module:Head0, number_of_clauses(Of)),
    predicate_property(ev3dev_instrument:clause_of(_, _),
                       number_of_clauses(Key)),
    (   clause_property(Clause, file(File)),
        clause_property(Clause, line_count(Line))
    ->  true
    ;   File = none,
        Line = 0
    ),
    assertz(clause_of(Key, place(Module:Name/Arity, Nth, Of, File, Line))),
    (   as_written(File, Line, Module, (Head1 :- Body1), Head, Body, Names)
    ->  assertz(named_body(Key, Body, Names))
    ;   Head = Head1,
        Body = Body1
    ),
    twin(Head, Module, Twin),
    node_of(Twin, Node),
    translate(Body, Module, Node, Recorded),
    assertz(ev3dev_recorded:(Twin :-
                                 ev3dev_recorded:unified(Node, Key),
                                 Recorded)).

%   as_written(+File, +Line, +Module, +Clause, -Head, -Body, -Names): what is
%   written there is Clause.

as_written(File, Line, Module, Clause, Head, Body, Names) :-
    File \== none,
    (   text(File, 0, _, _)
    ->  true
    ;   assertz(text(File, 0, none, [])),
        catch(setup_call_cleanup(
                  open(File, read, In, [encoding(utf8)]),
                  ( ( peek_char(In, #) -> skip(In, 0'\n) ; true ),
                    read_text(In, File, Module) ),
                  close(In)), error(_, _), true)
    ),
    text(File, Line, Text, Names),
    ( Text = (Head :- Body) -> true ; Head = Text, Body = true ),
    callable(Head),
    Head \= (_ --> _),
    catch(compiles_to(Head, Body, Clause), error(_, _), fail).

read_text(In, File, Module) :-
    catch(read_term(In, Term,
                    [ module(Module), variable_names(Names),
                      term_position(Position) ]),
          error(syntax_error(_), _), Term = none),
    (   Term == end_of_file
    ->  true
    ;   (   nonvar(Position)
        ->  stream_position_data(line_count, Position, Line),
            assertz(text(File, Line, Term, Names))
        ;   true
        ),
        read_text(In, File, Module)
    ).

%   Prolog compiles a dynamic clause in another way, unless it is the first.

compiles_to(Head0, Body0, (Head1 :- Body1)) :-
    Head0 =.. [Name|Arguments0],
    Head1 =.. [Name|Arguments1],
    Compared0 =.. [compared|Arguments0],
    Compared1 =.. [compared|Arguments1],
    functor(Compared1, compared, Arity),
    functor(Compared, compared, Arity),
    setup_call_cleanup(
        assertz(ev3dev_compared:(Compared0 :- Body0), Clause),
        clause(ev3dev_compared:Compared, Body, Clause),
        abolish(ev3dev_compared:compared/Arity)),
    (Compared :- Body) =@= (Compared1 :- Body1).

node_of(Twin, Node) :-
    functor(Twin, _, Arity),
    arg(Arity, Twin, Node).

% ---------------- GOALS

%!  translate(+Goal, +Module, +Node, -Recorded) is semidet.
%
%   Recorded does what Goal does in Module, and notes what happens in it.
%   Goal is in the body of Node's clause. Fails if it cannot be called.

translate(Goal, Module, Node, Recorded) :-
    var(Goal),
    !,
    translate(call(Goal), Module, Node, Recorded).
translate(true, _, _, true) :- !.
translate(!, _, Node, (ev3dev_recorded:cut(Node), !)) :- !.
translate((A0, B0), Module, Node, (A, B)) :-
    !,
    translate(A0, Module, Node, A),
    translate(B0, Module, Node, B).
translate((If0 -> Then0), Module, Node,
          (Before, If, ev3dev_recorded:cut(Inner) -> Then)) :-
    !,
    Before = ev3dev_recorded:local(Node, Inner),
    translate(If0, Module, Inner, If),
    translate(Then0, Module, Node, Then).
translate((If0 *-> Then0), Module, Node, (Before, If *-> Then)) :-
    !,
    Before = ev3dev_recorded:local(Node, Inner),
    translate(If0, Module, Inner, If),
    translate(Then0, Module, Node, Then).
translate((A0 ; B0), Module, Node, (A ; B)) :-
    !,
    translate(A0, Module, Node, A),
    translate(B0, Module, Node, B).
translate(Module0:Goal, _, Node, Recorded) :-
    atom(Module0),
    !,
    translate(Goal, Module0, Node, Recorded).
translate(Goal, Module, Node,
          ev3dev_recorded:goal(Node, Module:Goal, Exec, New)) :-
    callable(Goal),
    kind(Goal, Module, Kind),
    exec(Kind, Goal, Module, New, Exec).

%   What runs a goal depends on what it calls.

exec(twin(From), Goal, Module, Node, ev3dev_recorded:Twin) :-
    functor(Goal, Name, Arity),
    functor(Head, Name, Arity),
    twin(Head, From, Twin0),
    functor(Twin0, TwinName, _),
    Goal =.. [_|Arguments0],
    (   predicate_property(From:Head, meta_predicate(Modes))
    ->  Modes =.. [_|Specs],
        qualified(Arguments0, Specs, Module, Arguments1)
    ;   Arguments1 = Arguments0
    ),
    append_lists(Arguments1, [Node], Arguments),
    Twin =.. [TwinName|Arguments].
exec(meta(Modes), Goal, Module, Node, Module:Exec) :-
    Modes =.. [_|Specs],
    Goal =.. [Name|Arguments0],
    closures(Arguments0, Specs, Module, Node, Arguments),
    (   Name/Arguments = catch/[Try, Ball, _]
    ->  Goal = catch(_, _, Recovery),
        Exec = catch(Try, Ball,
                     ev3dev_recorded:recovered(Node, Ball, Module:Recovery))
    ;   Exec =.. [Name|Arguments]
    ).
exec(pack(How), Goal, Module, Node,
     ev3dev_recorded:leaf(How, Node, Module:Goal)).
exec(plain, Goal, Module, _, Module:Goal).

qualified([], [], _, []).
qualified([Argument0|Arguments0], [Spec|Specs], Module,
          [Argument|Arguments]) :-
    (   is_meta(Spec)
    ->  Argument = Module:Argument0
    ;   Argument = Argument0
    ),
    qualified(Arguments0, Specs, Module, Arguments).

is_meta(Spec) :-
    (   integer(Spec)
    ->  true
    ;   memberchk(Spec, [:, ^, //])
    ).

%   An argument that is called becomes one that notes what happens in it.

closures([], [], _, _, []).
closures([Argument0|Arguments0], [Spec|Specs], Module, Node,
         [Argument|Arguments]) :-
    (   closure(Spec, Argument0, Module, Node, Argument)
    ->  true
    ;   Argument = Argument0
    ),
    closures(Arguments0, Specs, Module, Node, Arguments).

closure(Spec, Goal, Module, Node,
        ev3dev_recorded:recorded(Node, Module:Goal)) :-
    integer(Spec),
    (   var(Goal)
    ->  true
    ;   callable(Goal)
    ).
closure(^, Goal0, Module, Node, Goal) :-
    nonvar(Goal0),
    (   Goal0 = Variable^Inner0
    ->  Goal = Variable^Inner,
        closure(^, Inner0, Module, Node, Inner)
    ;   closure(0, Goal0, Module, Node, Goal)
    ).
closure(//, Body, Module, Node, Goal) :-
    callable(Body),
    Body =.. [Name|Arguments0],
    append_lists(Arguments0, [_, _], Arguments),
    Called =.. [Name|Arguments],
    kind(Called, Module, twin(_)),
    closure(0, Body, Module, Node, Goal).

%!  kind(+Goal, +Module, -Kind) is det.
%
%   Kind is twin(Module) for a predicate of the program, meta(Modes) for one
%   of Prolog's that calls its arguments, pack(How) for one of the pack, else
%   `plain`. Golog has its own journal; what its interpreter calls is noise.

kind(Goal, Module, Kind) :-
    functor(Goal, Name, Arity),
    (   kind_(Name, Arity, Module, Kind0)
    ->  true
    ;   functor(Head, Name, Arity),
        kind_of(Head, Module, Kind0),
        assertz(kind_(Name, Arity, Module, Kind0))
    ),
    Kind = Kind0.

kind_of(Head, Module, Kind) :-
    (   predicate_property(Module:Head, imported_from(From))
    ->  true
    ;   From = Module
    ),
    (   twin(Head, From, _)
    ->  Kind = twin(From)
    ;   in_pack(From:x/0, _, _)
    ->  (   sub_atom(From, 0, _, _, ev3dev_golog)
        ->  Kind = pack(silent)
        ;   Kind = pack(recorded)
        )
    ;   predicate_property(Module:Head, meta_predicate(Modes)),
        \+ predicate_property(Module:Head, dynamic),
        Modes =.. [_|Specs],
        once(( one_of(Specs, Spec), Spec \== (:), is_meta(Spec) ))
    ->  Kind = meta(Modes)
    ;   Kind = plain
    ).
