:- module(old_uses,
          [ file_problem/3,             % +File, -Line, -Problem
            text_problem/3              % +Text, -Line, -Problem
          ]).
:- use_module(facts, [old_takes/1]).
:- use_module(guards, [branch/4, verdict/2]).
:- use_module(scope, [elsewhere/2, meta_head/2, newer/2, set_scope/2]).
:- use_module(terms,
              [ indicator/2, library_goal/3, read_terms/2, unqualified/2
              ]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(library(occurs), [sub_term/2]).

/** <module> Uses in a Prolog file of what SWI-Prolog 7.2.3 lacks

A file is read, not run. What 7.2.3 would not run is passed over. So newer
things may be used behind a test of the version, as in

    :- if((current_prolog_flag(version, V), V >= 70508)).
    :- if(exists_source(library(tables))).
    (   current_predicate(newer/1) -> newer(X) ; older(X) )

Only the syntax must be that of 7.2.3 there, too, because it reads what it
skips. If it is not known how a test ends, both branches are checked.

The options of a call are checked if they are written in it. A list of options
in a variable is not followed.
*/

%!  file_problem(+File, -Line, -Problem) is nondet.
%
%   True if the clause at Line has a Problem, a term Where-What: the facts
%   have no such line. Where is `predicate` for a call, and `syntax` for what
%   cannot be read.

file_problem(File, Line, Problem) :-
    absolute_file_name(File, Source),
    setup_call_cleanup(
        open(Source, read, Stream, [encoding(utf8)]),
        read_terms(Stream, Terms),
        close(Stream)),
    problem(Terms, Source, Line, Problem).

%!  text_problem(+Text, -Line, -Problem) is nondet.
%
%   As file_problem/3, for a Text.

text_problem(Text, Line, Problem) :-
    setup_call_cleanup(
        open_string(Text, Stream),
        read_terms(Stream, Terms),
        close(Stream)),
    problem(Terms, 'text.pl', Line, Problem).

problem(Terms, Source, Line, Problem) :-
    set_scope(Terms, Source),
    findall(Line-Problem,
            ( term_use(Terms, Line, Use), newer(Use, Problem) ),
            Problems0),
    sort(Problems0, Problems),
    member(Line-Problem, Problems).

%   term_use(+Terms, -Line, -Use) is nondet.

term_use(Terms, Line, Use) :-
    term_use(Terms, [], Line, Use).

term_use([Line0-Term|Terms], Branches0, Line, Use) :-
    (   Term = (:- Directive),
        branch(Directive, Branches0, Branches, Condition)
    ->  (   Line = Line0,
            condition_use(Condition, Use)
        ;   term_use(Terms, Branches, Line, Use)
        )
    ;   (   Line = Line0,
            syntax_use(Term, Use)
        ;   \+ memberchk(branch(false, _), Branches0),
            Line = Line0,
            clause_use(Term, Use)
        ;   term_use(Terms, Branches0, Line, Use)
        )
    ).

%   Version 7.2.3 has no syntax for rational numbers, `inf` and `nan`.

syntax_use(unreadable(Why), syntax-Why) :-
    !.
syntax_use(Term, syntax-Number) :-
    sub_term(Number, Term),
    number(Number),
    (   float(Number),
        \+ abs(Number) =< 1.7976931348623157e308
    ;   rational(Number),
        \+ integer(Number)
    ).

clause_use((:- Directive), Use) :-
    !,
    \+ Directive = module(_, _),
    goal_use(Directive, Use).
clause_use((?- Directive), Use) :-
    !,
    goal_use(Directive, Use).
clause_use(Term, Use) :-
    Term = (Head --> Body),
    !,
    (   Head = prolog:Message,
        hook_use(Message, 2, Use)
    ;   Head = prolog:_,
        element_use(Body, Use)
    ;   text_use(Body, Use)
    ;   dcg_translate_rule(Term, (_ :- Goal)),
        goal_use(Goal, Use)
    ).
clause_use((Head :- Body), Use) :-
    !,
    (   Head = prolog:Hook,
        hook_use(Hook, 0, Use)
    ;   goal_use(Body, Use)
    ).
clause_use(prolog:Hook, Use) :-
    hook_use(Hook, 0, Use).

hook_use(Hook, More, hook-Name/Arity) :-
    callable(Hook),
    indicator(Hook, Name/Arity0),
    Arity is Arity0+More.

element_use(Body, _) :-
    var(Body),
    !,
    fail.
element_use(Body, Use) :-
    compound(Body),
    memberchk(Body, [(A, B), (A ; B), (A -> B), (A *-> B), '|'(A, B)]),
    !,
    (   element_use(A, Use)
    ;   element_use(B, Use)
    ).
element_use(Body, element-Element) :-
    is_list(Body),
    member(Term, Body),
    compound(Term),
    indicator(Term, Element).

%   Lines of messages: Format-Arguments

text_use(Term, Use) :-
    sub_term(Pair, Term),
    nonvar(Pair),
    Pair = Text-Arguments,
    is_list(Arguments),
    format_use(Text, Use).

%   goal_use(+Goal, -Use) is nondet.

goal_use(Goal, _) :-
    \+ callable(Goal),
    !,
    fail.
goal_use((A, B), Use) :-
    !,
    (   goal_use(A, Use)
    ;   verdict(A, Truth),
        Truth \== false,
        goal_use(B, Use)
    ).
goal_use((If -> Then ; Else), Use) :-
    !,
    if_use(If, Then, Else, Use).
goal_use((If *-> Then ; Else), Use) :-
    !,
    if_use(If, Then, Else, Use).
goal_use((If -> Then), Use) :-
    !,
    if_use(If, Then, fail, Use).
goal_use((If *-> Then), Use) :-
    !,
    if_use(If, Then, fail, Use).
goal_use((A ; B), Use) :-
    !,
    (   goal_use(A, Use)
    ;   goal_use(B, Use)
    ).
goal_use('|'(A, B), Use) :-
    !,
    goal_use((A ; B), Use).
goal_use(\+ Goal, Use) :-
    !,
    condition_use(Goal, Use).
goal_use(Module:Goal, Use) :-
    !,
    callable(Goal),
    goal_use(Goal, Use),
    \+ ( Use = predicate-Predicate,
         indicator(Goal, Predicate),
         elsewhere(Module, Goal)
       ).
goal_use(Goal, predicate-Predicate) :-
    indicator(Goal, Predicate).
goal_use(Goal, Use) :-
    argument_use(Goal, Use).
goal_use(Goal, Use) :-
    meta_head(Goal, Meta),
    arg(N, Meta, How),
    arg(N, Goal, Argument),
    called(How, Argument, Called),
    goal_use(Called, Use).
goal_use(Goal, Use) :-
    memberchk(Goal, [assert(Clause0), asserta(Clause0), assertz(Clause0)]),
    unqualified(Clause0, Clause),
    nonvar(Clause),
    Clause = (_ :- Body),
    goal_use(Body, Use).

if_use(If, _, _, Use) :-
    condition_use(If, Use).
if_use(If, Then, Else, Use) :-
    verdict(If, Truth),
    (   Truth \== false,
        goal_use(Then, Use)
    ;   Truth \== true,
        goal_use(Else, Use)
    ).

%   A test may name what 7.2.3 lacks.

condition_use(Goal, _) :-
    \+ callable(Goal),
    !,
    fail.
condition_use((A, B), Use) :-
    !,
    (   condition_use(A, Use)
    ;   verdict(A, Truth),
        Truth \== false,
        condition_use(B, Use)
    ).
condition_use((A ; B), Use) :-
    \+ A = (_ -> _),
    \+ A = (_ *-> _),
    !,
    (   condition_use(A, Use)
    ;   condition_use(B, Use)
    ).
condition_use(Goal, Use) :-
    (   Goal \= (\+ _),
        copy_term(Goal, Copy),
        verdict(Copy, Truth),
        Truth \== unknown
    ->  indicator(Goal, Predicate),
        Use = predicate-Predicate
    ;   goal_use(Goal, Use)
    ).

called(How, Argument, Called) :-
    nonvar(Argument),
    (   integer(How)
    ->  more_arguments(Argument, How, Called)
    ;   How == (^)
    ->  without_carets(Argument, Called)
    ;   How == (//)
    ->  more_arguments(Argument, 2, Called)
    ).

without_carets(Goal, Goal) :-
    var(Goal),
    !.
without_carets(_^Goal0, Goal) :-
    !,
    without_carets(Goal0, Goal).
without_carets(Goal, Goal).

more_arguments(Goal, _, _) :-
    \+ callable(Goal),
    !,
    fail.
more_arguments(Module:Goal0, N, Module:Goal) :-
    !,
    more_arguments(Goal0, N, Goal).
more_arguments(Goal0, N, Goal) :-
    length(More, N),
    Goal0 =.. Parts0,
    append(Parts0, More, Parts),
    Goal =.. Parts.

% ---------------- ARGUMENTS

argument_use(Goal, Use) :-
    evaluated(Goal, Expression),
    expression_use(Expression, Use).
argument_use(Goal, flag-Flag) :-
    flag_of(Goal, Flag0),
    unqualified(Flag0, Flag),
    atom(Flag).
argument_use(Goal, option(Predicate)-Option) :-
    indicator(Goal, Predicate),
    old_takes(option(Predicate)),
    last_argument(Goal, Options),
    in_list(Options, Option0),
    (   Option0 = (Name=Value)
    ->  atom(Name),
        Option =.. [Name, Value]
    ;   Option = Option0
    ).
argument_use(Goal, property(Predicate)-Property) :-
    indicator(Goal, Predicate),
    old_takes(property(Predicate)),
    last_argument(Goal, Property),
    callable(Property).
argument_use(Goal, key(Predicate)-Key) :-
    indicator(Goal, Predicate),
    old_takes(key(Predicate)),
    arg(1, Goal, Key0),
    key(Key0, Key).
argument_use(Goal, Use) :-
    format_of(Goal, Format),
    format_use(Format, Use).
argument_use(tmp_file_stream(File, _, Options),
             key(tmp_file_stream/3)-options) :-
    var(File),
    nonvar(Options).
argument_use(Goal, Use) :-
    library_goal(Goal, library(Library), Imports),
    (   Use = library-Library
    ;   import(Imports, Import),
        Use = import(Library)-Import
    ).

%   Functions

evaluated(_ is E, E).
evaluated(A =:= B, E) :- ( E = A ; E = B ).
evaluated(A =\= B, E) :- ( E = A ; E = B ).
evaluated(A < B, E)   :- ( E = A ; E = B ).
evaluated(A > B, E)   :- ( E = A ; E = B ).
evaluated(A =< B, E)  :- ( E = A ; E = B ).
evaluated(A >= B, E)  :- ( E = A ; E = B ).
evaluated(tab(E), E).
evaluated(tab(_, E), E).

expression_use(Expression, _) :-
    \+ callable(Expression),
    !,
    fail.
expression_use([Expression|_], Use) :-
    !,
    expression_use(Expression, Use).
expression_use(Expression, _) :-
    indicator(Expression, '.'/2),       % of a dict
    !,
    fail.
expression_use(Expression, function-Function) :-
    indicator(Expression, Function).
expression_use(Expression, Use) :-
    compound(Expression),
    arg(_, Expression, Argument),
    expression_use(Argument, Use).

%   A call with a value is a test, which fails if there is no such flag.

flag_of(current_prolog_flag(Flag, Value), Flag) :-
    var(Value).
flag_of(set_prolog_flag(Flag, _), Flag).
flag_of(create_prolog_flag(Flag, _, _), Flag).

last_argument(Goal, Last) :-
    indicator(Goal, _/Arity),
    arg(Arity, Goal, Last0),
    unqualified(Last0, Last).

in_list(List, Member) :-
    nonvar(List),
    List = [Head|Tail],
    (   Member = Head,
        callable(Head)
    ;   in_list(Tail, Member)
    ).

key(Key0, Key) :-
    callable(Key0),
    (   Key = Key0
    ;   Key0 = list(Key1),
        key(Key1, Key)
    ).

import(Imports0, Import) :-
    nonvar(Imports0),
    (   Imports0 = except(Imports)
    ->  true
    ;   Imports = Imports0
    ),
    in_list(Imports, Import0),
    (   Import0 = (Import1 as _)
    ->  true
    ;   Import1 = Import0
    ),
    (   Import1 = Name//Arity0
    ->  Arity is Arity0+2,
        Import = Name/Arity
    ;   Import = Import1
    ).

%   Formats

format_of(format(Format), Format).
format_of(format(Format, _), Format).
format_of(format(_, Format, _), Format).
format_of(debug(_, Format, _), Format).
format_of(ansi_format(_, Format, _), Format).
format_of(print_message(_, Message), Format) :-
    nonvar(Message),
    Message = format(Format, _).

format_use(Format, directive-Letter) :-
    catch(text_to_string(Format, Text), _, fail),
    string_chars(Text, Chars),
    directive(Chars, Letter).

directive([~|Chars0], Letter) :-
    !,
    column(Chars0, Chars1),
    (   Chars1 = [:|Chars]
    ->  true
    ;   Chars = Chars1
    ),
    Chars = [Char|Rest],
    (   Letter = Char
    ;   directive(Rest, Letter)
    ).
directive([_|Chars], Letter) :-
    directive(Chars, Letter).

column([*|Chars], Chars) :-
    !.
column(['`', _|Chars], Chars) :-
    !.
column([Digit|Chars0], Chars) :-
    char_type(Digit, digit),
    !,
    column(Chars0, Chars).
column(Chars, Chars).
