:- module(ev3dev_golog_pddl_grammar,
          [ read_define/5,              % +File, +What, -Name, -Parts, -Path
            part/4,                     % +Keyword, +Parts, -Place, -Items
            fields/4,                   % +In, +Items, +Path, -Parts
            keywords/3,                 % +Kind, +Items, +Path
            names/4,                    % +List, +Kind, +Path, -Names
            shape/3,                    % ?Kind, ?Word, ?Count
            shaped/5,                   % +Kind, +Word, +Place, +Items, +Path
            not_read/3,                 % +Word, +Place, +Path
            distinct/3,                 % +Places, +What, +Path
            unknown/5,                  % +Kind, +Name, +Place, +Known, +Path
            shown/2                     % +Expression, -Text
          ]).
:- use_module(library(lists), [member/2]).
:- use_module(s_expressions, [expression/3, wrong/3, wrong/4]).
:- use_module('../errors/error_texts', [nearly/3]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../files/directory', [readable_file/3]).

/** <module> The grammar of PDDL

The tables of this file say what is read; all else is refused.
*/

%   keyword(?In, ?Keyword, ?Times): Times is `once` or `often`.

keyword(domain, ':requirements', once).
keyword(domain, ':types', once).
keyword(domain, ':constants', once).
keyword(domain, ':predicates', once).
keyword(domain, ':functions', once).
keyword(domain, ':action', often).
keyword(domain, ':derived', often).
keyword(action, ':parameters', once).
keyword(action, ':precondition', once).
keyword(action, ':effect', once).
keyword(problem, ':domain', once).
keyword(problem, ':requirements', once).
keyword(problem, ':objects', once).
keyword(problem, ':init', once).
keyword(problem, ':goal', once).
keyword(problem, ':metric', once).
keyword(requirement, Keyword, once) :-
    member(Keyword,
           [ ':strips', ':typing', ':negative-preconditions',
             ':disjunctive-preconditions', ':equality',
             ':existential-preconditions', ':universal-preconditions',
             ':quantified-preconditions', ':conditional-effects', ':adl',
             ':derived-predicates', ':action-costs',
             % They allow more; what a file uses of it is refused there.
             ':fluents', ':numeric-fluents', ':object-fluents',
             ':durative-actions', ':duration-inequalities',
             ':continuous-effects', ':timed-initial-literals', ':time',
             ':preferences', ':constraints', ':goal-utilities' ]).

%!  shape(?Kind, ?Word, ?Count) is nondet.
%
%   Count is how many parts follow Word in an expression.

shape(condition, and, any).
shape(condition, or, any).
shape(condition, not, 1).
shape(condition, imply, 2).
shape(condition, exists, 2).
shape(condition, forall, 2).
shape(condition, =, 2).
shape(effect, and, any).
shape(effect, not, 1).
shape(effect, when, 2).
shape(effect, forall, 2).
shape(effect, increase, 2).

%   beyond(?Word, ?What): a word of the languages for more than actions in
%   sequence, conditions that are true or false, and costs.

beyond(':durative-action', 'actions that take time').
beyond(':process', 'processes').
beyond(':event', 'events').
beyond(':constraints', 'constraints').
beyond(':axiom', 'axioms of PDDL 1, as opposed to :derived,').
beyond(':safety', 'axioms of safety').
beyond(':timeless', 'timeless facts').
beyond(':vars', 'variables beside the parameters').
beyond(':situation', 'situations').
beyond(':length', 'lengths of plans').
beyond(':observe', 'actions that sense').
beyond(':method', 'methods').
beyond(':task', 'tasks').
beyond(':htn', 'tasks').
beyond(preference, 'preferences').
beyond(probabilistic, 'probabilities').
beyond(oneof, 'effects of chance').
beyond(Word, 'numbers other than costs') :-
    member(Word, [ <, >, <=, >=, =, assign, increase, decrease, 'scale-up',
                   'scale-down' ]).

%!  read_define(+File, +What, -Name, -Parts, -Path) is det.
%
%   File is a `domain` or a `problem`. Parts are part(Keyword, Place, Items),
%   all of them known.
%
%   @error existence_error(source_sink, File)
%   @error syntax_error(pddl), with path, line and column

read_define(File, What, Name, Parts, Path) :-
    (   readable_file(File, pddl, Path)
    ->  true
    ;   throw_error(existence_error(source_sink, File), _, '')
    ),
    setup_call_cleanup(
        open(Path, read, Stream, [encoding(utf8)]),
        expression(Stream, Path, e(Place, E)),
        close(Stream)),
    (   E = [e(_, define), e(_, [e(_, What), e(_, Name)])|Es],
        atom(Name)
    ->  true
    ;   wrong(Path, Place, 'it does not begin with (define (~w NAME)'-[What])
    ),
    parts(Es, What, Path, Parts).

parts([], _, _, []).
parts([e(Place, E)|Es], In, Path, [part(Keyword, Place, Items)|Parts]) :-
    (   E = [e(_, Keyword)|Items],
        is_keyword(Keyword)
    ->  known(In, Keyword, Place, Path)
    ;   expected('a part such as (:init ..)', e(Place, E), Path)
    ),
    parts(Es, In, Path, Parts),
    once_only(In, Keyword, Parts, Path).

%!  fields(+In, +Items, +Path, -Parts) is det.
%
%   As the parts of read_define/5, for Items with a keyword before each.

fields(In, Items, Path, Parts) :-
    (   Items = [E|Rest]
    ->  E = e(Place, Keyword),
        (   is_keyword(Keyword)
        ->  known(In, Keyword, Place, Path)
        ;   expected('a keyword such as :effect', E, Path)
        ),
        (   Rest = [Value|Items1],
            \+ ( Value = e(_, Word), is_keyword(Word) )
        ->  true
        ;   wrong(Path, Place, 'nothing stands after ~w'-[Keyword])
        ),
        Parts = [part(Keyword, Place, [Value])|Parts1],
        fields(In, Items1, Path, Parts1),
        once_only(In, Keyword, Parts1, Path)
    ;   Parts = []
    ).

is_keyword(Word) :-
    atom(Word),
    sub_atom(Word, 0, 1, _, :).

known(In, Keyword, Place, Path) :-
    (   keyword(In, Keyword, _)
    ->  true
    ;   not_read(Keyword, Place, Path),
        (   In == requirement
        ->  Formal = domain_error(pddl_requirement, Keyword)
        ;   Formal = domain_error(pddl_keyword, Keyword)
        ),
        findall(Known, keyword(In, Known, _), AllKnown),
        hint(Keyword, AllKnown, Hint),
        wrong(Path, Place, '~w is not known here~w'-[Keyword, Hint],
              Formal)
    ).

once_only(In, Keyword, Parts, Path) :-
    (   keyword(In, Keyword, once),
        memberchk(part(Keyword, Place, _), Parts)
    ->  wrong(Path, Place, '~w comes a second time'-[Keyword])
    ;   true
    ).

%!  part(+Keyword, +Parts, -Place, -Items) is nondet.

part(Keyword, Parts, Place, Items) :-
    member(part(Keyword, Place, Items), Parts).

%!  keywords(+Kind, +Items, +Path) is det.
%
%   Check the Items of a list such as (:requirements ..).

keywords(Kind, Items, Path) :-
    forall(member(e(Place, Name), Items), known(Kind, Name, Place, Path)).

%!  not_read(+Word, +Place, +Path) is det.
%
%   @error domain_error(pddl_keyword, Word) if it belongs to a language that
%          is not read

not_read(Word, Place, Path) :-
    (   beyond(Word, What)
    ->  wrong(Path, Place, '~w (~w) are not read, only STRIPS, ADL, \c
                            :derived and :action-costs'-[What, Word],
              domain_error(pddl_keyword, Word))
    ;   true
    ).

%!  shaped(+Kind, +Word, +Place, +Items, +Path) is semidet.
%
%   True if Word begins a Kind of expression, with Items after it.
%
%   @error syntax_error(pddl) if it is not followed by as many as Items

shaped(Kind, Word, Place, Items, Path) :-
    shape(Kind, Word, Count),
    length(Items, Length),
    (   memberchk(Count, [any, Length])
    ->  true
    ;   wrong(Path, Place, 'the number of parts of (~w ..) is ~d, not ~d'-
                           [Word, Count, Length])
    ).

%!  names(+List, +Kind, +Path, -Names) is det.
%
%   Names are name(Name, Types, Place) for each of a List such as
%   `a b - t c - (either t u) d`. Kind is `variable` if they begin with a
%   question mark, else `name`; `skeleton` for lists such as (at ?x), whose
%   type is `number` if there is none.

names(List, Kind, Path, Names) :-
    names(List, [], Kind, Path, Names).

names([], New, Kind, _, Names) :-
    ( Kind == skeleton -> Types = [number] ; Types = [object] ),
    of_types(New, Types, Names, []).
names([Item|Items], New, Kind, Path, Names) :-
    (   Item = e(Place, -)
    ->  (   Items = [e(_, Type)|Rest],
            New \== [],
            types(Type, Types)
        ->  of_types(New, Types, Names, Names1),
            names(Rest, [], Kind, Path, Names1)
        ;   wrong(Path, Place, 'before - stands a name, after it a type'-[])
        )
    ;   is_a(Kind, Item)
    ->  names(Items, [Item|New], Kind, Path, Names)
    ;   expected(Kind, Item, Path)
    ).

types(Type, Types) :-
    (   is_a(name, e(_, Type))
    ->  Types = [Type]
    ;   Type = [e(_, either)|Es],
        \+ ( member(E, Es), \+ is_a(name, E) ),
        findall(T, member(e(_, T), Es), Types)
    ).

%   of_types(+Reversed, +Types, -Names, ?Rest)

of_types([], _, Names, Names).
of_types([e(Place, Name)|Es], Types, Names, Rest) :-
    of_types(Es, Types, Names, [name(Name, Types, Place)|Rest]).

is_a(Kind, e(_, Item)) :-
    (   Kind == skeleton
    ->  Item = [e(_, Name)|_],
        is_a(name, e(_, Name))
    ;   atom(Item),
        sub_atom(Item, 0, 1, _, First),
        (   Kind == variable
        ->  First == (?)
        ;   \+ memberchk(First, [?, :, -])
        )
    ).

expected(What, E, Path) :-
    E = e(Place, _),
    (   What == variable
    ->  Wanted = 'a variable such as ?x'
    ;   What == skeleton
    ->  Wanted = 'a list such as (at ?x)'
    ;   What == name
    ->  Wanted = 'a name'
    ;   Wanted = What
    ),
    shown(E, Text),
    wrong(Path, Place, '~w is expected, not ~w'-[Wanted, Text]).

%!  distinct(+Places, +What, +Path) is det.
%
%   Places are Name-Place.
%
%   @error syntax_error(pddl) if a Name comes twice

distinct(Places, What, Path) :-
    keysort(Places, Sorted),
    (   adjacent(Sorted, Name-(Line:_), Name-Place)
    ->  wrong(Path, Place, '~w ~w is there already, in line ~d'-
                           [What, Name, Line])
    ;   true
    ).

adjacent([First|Rest], A, B) :-
    (   Rest = [Second|_],
        First = A,
        Second = B
    ->  true
    ;   adjacent(Rest, A, B)
    ).

%!  unknown(+Kind, +Name, +Place, +Known, +Path).
%
%   @error existence_error(Kind, Name). Kind is `pddl_type` or such.

unknown(Kind, Name, Place, Known, Path) :-
    hint(Name, Known, Hint),
    atom_concat(pddl_, Words, Kind),
    wrong(Path, Place, 'the ~w ~w is not declared~w'-[Words, Name, Hint],
          existence_error(Kind, Name)).

hint(Name, Known, Hint) :-
    (   nearly(Name, Known, Meant)
    ->  format(atom(Hint), '. Did you mean ~w?', [Meant])
    ;   Hint = ''
    ).

%!  shown(+Expression, -Text) is det.

shown(e(_, Item), Text) :-
    (   atom(Item)
    ->  Text = Item
    ;   findall(Part, ( member(E, Item), shown(E, Part) ), Parts),
        atomic_list_concat(Parts, ' ', Inner),
        format(atom(Text), '(~w)', [Inner])
    ).
