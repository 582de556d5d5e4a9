:- module(old_terms,
          [ read_terms/2,               % +Stream, -Terms
            declared_exports/2,         % +File, -Exports
            library_goal/3,             % +Goal, -Spec, -Imports
            unqualified/2,              % ?Term0, -Term
            indicator/2                 % +Term, -Indicator
          ]).
:- use_module(facts, [old/2, old_export/2]).
:- use_module(library(gensym), [gensym/2]).
:- use_module(library(lists), [member/2]).

/** <module> The terms of a file, read as SWI-Prolog 7.2.3 would

The operators are those of 7.2.3, and what the file adds to them.
*/

%!  read_terms(+Stream, -Terms) is det.
%
%   Terms is a list of Line-Term. A term that cannot be read is
%   unreadable(Why).

read_terms(Stream, Terms) :-
    (   peek_char(Stream, #)
    ->  skip(Stream, '\n')
    ;   true
    ),
    gensym(old_syntax, Module),
    set_operators(Module),
    read_terms(Stream, Module, Terms).

read_terms(Stream, Module, Terms) :-
    read_one(Stream, Module, Line, Term),
    (   Term == end_of_file
    ->  Terms = []
    ;   Terms = [Line-Term|Terms1],
        forall(new_operator(Term, Operator), set_operator(Operator, Module)),
        read_terms(Stream, Module, Terms1)
    ).

read_one(Stream, Module, Line, Term) :-
    catch(read_term(Stream, Term0,
                    [module(Module), term_position(Position)]),
          error(syntax_error(Why), Place), true),
    (   nonvar(Why)
    ->  Term = unreadable(Why),
        arg(2, Place, Line)
    ;   stream_position_data(line_count, Position, Line),
        with_positions(Term0, Term)
    ).

%   Records whose fields have names are replaced when a file is compiled.

with_positions(Term0, Term) :-
    (   Term0 = (Head :- Body0),
        ev3dev_fields:goal_expansion(Body0, Body)
    ->  Term = (Head :- Body)
    ;   Term = Term0
    ).

%   The operators of 7.2.3, whatever the running version has.

set_operators(Module) :-
    forall(( current_op(Priority, Type, Name),
             \+ old(operator, op(Priority, Type, Name))
           ),
           set_operator(op(0, Type, Name), Module)),
    forall(( old(operator, op(Priority, Type, Name)),
             \+ current_op(Priority, Type, Name)
           ),
           set_operator(op(Priority, Type, Name), Module)).

set_operator(op(Priority, Type, Name), Module) :-
    op(Priority, Type, Module:Name).

new_operator((:- op(Priority, Type, Name)), op(Priority, Type, Name)).
new_operator((:- module(_, Exports)), op(Priority, Type, Name)) :-
    is_list(Exports),
    member(op(Priority, Type, Name), Exports).
new_operator((:- Directive), op(Priority, Type, Name)) :-
    library_goal(Directive, library(Library), _),
    (   old_export(Library, op(Priority, Type, Name))
    ;   pack_export(Library, op(Priority, Type, Name))
    ).

%   What a library of the pack exports.
pack_export(ev3dev/Name, Export) :-
    atomic_list_concat(['prolog/ev3dev/', Name, '.pl'], File),
    exists_file(File),
    declared_exports(File, Exports),
    member(Export, Exports).

%!  declared_exports(+File, -Exports) is semidet.
%
%   True if File is that of a module, and Exports is the list in it.

declared_exports(File, Exports) :-
    setup_call_cleanup(
        open(File, read, Stream, [encoding(utf8)]),
        read_one(Stream, user, _, Term),
        close(Stream)),
    Term = (:- module(_, Exports)).

%!  library_goal(+Goal, -Spec, -Imports) is nondet.
%
%   True if Goal loads the file Spec, and imports Imports or `all` of it.

library_goal(Goal, Spec, Imports) :-
    load_goal(Goal, Specs, Imports),
    nonvar(Specs),
    (   is_list(Specs)
    ->  member(Spec, Specs)
    ;   Spec = Specs
    ),
    nonvar(Spec).

load_goal(use_module(Spec), Spec, all).
load_goal(use_module(Spec, Imports), Spec, Imports).
load_goal(autoload(Spec), Spec, all).
load_goal(autoload(Spec, Imports), Spec, Imports).
load_goal(reexport(Spec), Spec, all).
load_goal(reexport(Spec, Imports), Spec, Imports).
load_goal(ensure_loaded(Spec), Spec, all).
load_goal(consult(Spec), Spec, all).
load_goal(load_files(_:Spec, _), Spec, all).
load_goal(load_files(Spec, _), Spec, all).

%!  unqualified(?Term0, -Term) is det.
%
%   True if Term is Term0 without its module, if it has one.

unqualified(Term0, Term) :-
    (   nonvar(Term0),
        Term0 = _:Term1
    ->  unqualified(Term1, Term)
    ;   Term = Term0
    ).

%!  indicator(+Term, -Indicator) is det.
%
%   True if Indicator is the Name/Arity of a callable Term.

indicator(Term, Name/Arity) :-
    (   compound(Term)
    ->  compound_name_arity(Term, Name, Arity)
    ;   Name = Term,
        Arity = 0
    ).
