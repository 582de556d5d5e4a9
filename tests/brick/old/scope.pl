:- module(old_scope,
          [ set_scope/2,                % +Terms, +Source
            newer/2,                    % +Use, -Problem
            elsewhere/2,                % ?Module, +Goal
            meta_head/2                 % +Goal, -Meta
          ]).
:- use_module(facts, [old/2, old_export/2, newer_term/3]).
:- use_module(terms,
              [ declared_exports/2, indicator/2, library_goal/3, read_terms/2,
                unqualified/2
              ]).
:- use_module(library(lists), [member/2]).

/** <module> Predicates that a file may use: of SWI-Prolog 7.2.3, and of its own
*/

:- dynamic
    own/1,                              % Name/Arity: defined or imported
    own_meta/1,                         % Head of a meta_predicate
    own_function/1,                     % Name/Arity
    own_type/1,                         % Type of must_be/2
    used_library/1,                     % Library
    context/1.                          % Module

%!  set_scope(+Terms, +Source) is det.
%
%   The file Source with these Terms is the one that newer/2 and meta_head/2
%   are about.

set_scope(Terms, Source) :-
    retractall(own(_)),
    retractall(own_meta(_)),
    retractall(own_function(_)),
    retractall(own_type(_)),
    retractall(used_library(_)),
    retractall(context(_)),
    (   module_property(Module, file(Source))
    ->  true
    ;   Module = user
    ),
    assertz(context(Module)),
    forall(( member(_-Term, Terms), defined(Term, Source, Fact) ),
           assertz(Fact)).

defined((:- Directive), Source, Fact) :-
    !,
    declared(Directive, Source, Fact).
defined(Term, _, own_type(Type)) :-
    clause_head(Term, error:has_type(Type, _), 0),
    nonvar(Type).
defined(Term, _, own(Name/Arity)) :-
    clause_head(Term, Head, More),
    unqualified(Head, Plain),
    indicator(Plain, Name/Arity0),
    Arity is Arity0+More.

clause_head((Head :- _), Head, 0) :-
    !.
clause_head((Head, _ --> _), Head, 2) :-
    !.
clause_head((Head --> _), Head, 2) :-
    !.
clause_head(Head, Head, 0) :-
    callable(Head).

declared((A, B), Source, Fact) :-
    !,
    (   declared(A, Source, Fact)
    ;   declared(B, Source, Fact)
    ).
declared(meta_predicate(Heads), _, own_meta(Head)) :-
    in_commas(Heads, Head).
declared(arithmetic_function(Function), _, own_function(Function)).
declared(Declaration, _, own(Name/Arity)) :-
    memberchk(Declaration,
              [ dynamic(Predicates), multifile(Predicates),
                thread_local(Predicates), volatile(Predicates)
              ]),
    in_commas(Predicates, Predicate0),
    unqualified(Predicate0, Predicate),
    (   Predicate = Name/Arity
    ;   Predicate = Name//Arity0,
        Arity is Arity0+2
    ).
declared(Goal, Source, Fact) :-
    library_goal(Goal, Spec, _),
    (   Spec = library(Library),
        Fact = used_library(Library)
    ;   exported(Spec, Source, Name/Arity),
        Fact = own(Name/Arity)
    ).

in_commas(Terms, _) :-
    var(Terms),
    !,
    fail.
in_commas((A, B), Term) :-
    !,
    (   in_commas(A, Term)
    ;   in_commas(B, Term)
    ).
in_commas([A|B], Term) :-
    !,
    (   in_commas(A, Term)
    ;   in_commas(B, Term)
    ).
in_commas(Term, Term) :-
    Term \== [].

%   What a file that lies in the pack exports.

exported(Spec, Source, Export) :-
    \+ ( Spec = library(Library), old_export(Library, _) ),
    absolute_file_name(Spec, File,
                       [ file_type(prolog), access(read), relative_to(Source),
                         file_errors(fail)
                       ]),
    absolute_file_name('.', Pack),
    sub_atom(File, 0, _, _, Pack),
    (   module_property(Module, file(File))
    ->  module_property(Module, exports(Exports)),
        member(Export, Exports)
    ;   declared_exports(File, Exports)
    ->  member(Export, Exports)
    ;   loaded_by(File, Loaded),
        exported(Loaded, File, Export)
    ).

%   A file without a module passes on what it loads.

loaded_by(File, Loaded) :-
    setup_call_cleanup(
        open(File, read, Stream, [encoding(utf8)]),
        read_terms(Stream, Terms),
        close(Stream)),
    member(_-(:- Goal), Terms),
    library_goal(Goal, Loaded, _).

%!  newer(+Use, -Problem) is semidet.
%
%   True if Use is neither the file's own nor in 7.2.3. Problem is the term
%   Where-What that would be in the facts.

newer(predicate-Predicate, predicate-Predicate) :-
    \+ callable_predicate(Predicate).
newer(import(Library)-Export, library(Library)-Export) :-
    \+ newer(library-Library, _),
    \+ is_ours(Library),
    \+ old_export(Library, Export).
newer(library-Library, library-Library) :-
    \+ is_ours(Library),
    \+ old_export(Library, _).
newer(function-Function, function-Function) :-
    \+ old(function, Function),
    \+ own_function(Function).
newer(flag-Flag, flag-Flag) :-
    \+ old(flag, Flag),
    \+ sub_atom(Flag, 0, _, _, ev3dev_).
newer(option(Predicate)-Option, option(Predicate)-What) :-
    newer_term(option(Predicate), Option, What).
newer(property(Predicate)-Property, property(Predicate)-What) :-
    newer_term(property(Predicate), Property, What),
    % library(ev3dev) teaches it to old versions.
    \+ ( Predicate-What == (initialization)/2-main,
         used_library(ev3dev)
       ).
newer(key(Predicate)-Key, key(Predicate)-What) :-
    newer_term(key(Predicate), Key, What),
    \+ ( memberchk(Predicate, [must_be/2, is_of_type/2]),
         own_type(Key)
       ).
newer(directive-Letter, directive-Letter) :-
    \+ old(directive, Letter).
newer(element-Element, element-Element) :-
    \+ old(element, Element).
newer(hook-Hook, hook-Hook) :-
    \+ old(hook, Hook).
newer(syntax-What, syntax-What).

callable_predicate(Predicate) :-
    own(Predicate),
    !.
callable_predicate(Predicate) :-
    old(system, Predicate),
    !.
callable_predicate(Predicate) :-
    old(library(Library), Predicate),
    (   atom(Library)                   % loaded when it is called
    ;   used_library(Library)
    ;   Library = clp/Name,
        used_library(Name)
    ),
    !.
callable_predicate(encoding/1).         % a directive
callable_predicate('.'/2).              % of a dict
callable_predicate(Predicate) :-
    context(Module),
    Module \== user,
    Predicate = Name/Arity,
    functor(Head, Name, Arity),
    predicate_property(Module:Head, foreign),
    \+ predicate_property(Module:Head, imported_from(_)),
    \+ predicate_property(Module:Head, built_in).

is_ours(ev3dev).
is_ours(Folder/_) :-
    is_ours(Folder).

%!  elsewhere(?Module, +Goal) is semidet.
%
%   True if another file has to define Module:Goal. What the system defines is
%   the same in all modules.

elsewhere(Module, Goal) :-
    (   var(Module)
    ->  true
    ;   Module == user
    ->  true
    ;   sub_atom(Module, 0, _, _, ev3dev)
    ),
    \+ predicate_property(system:Goal, built_in),
    !.
elsewhere(Module, Goal) :-
    atom(Module),
    indicator(Goal, Predicate),
    old(module(Module), Predicate),
    !.

%!  meta_head(+Goal, -Meta) is semidet.
%
%   True if Meta says which arguments of Goal are goals.

meta_head(Goal, Meta) :-
    indicator(Goal, Name/Arity),
    functor(Meta, Name, Arity),
    (   own_meta(Meta)
    ->  true
    ;   context(Module),
        catch(predicate_property(Module:Goal, meta_predicate(Meta)), _, fail)
    ).
