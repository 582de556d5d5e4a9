/*  Lists what SWI-Prolog 7.2.3 has, as far as it can be asked: predicates,
    libraries, functions, operators and flags. To be run by 7.2.3:

        swipl -f none -s tests/brick/old/list.pl \
            > tests/brick/swipl-7.2.3.txt 2> /dev/null
*/

:- initialization(main).

main :-
    set_prolog_flag(debug_on_error, false),
    findall(Where-What, fact(Where, What), Facts0),
    sort(Facts0, Facts),
    format('% What SWI-Prolog 7.2.3 has: made by old/list.pl, read by '),
    format('old/facts.pl~n'),
    write_facts(Facts),
    halt.

%   A term for each Where, in lines of 98 columns

write_facts(Facts) :-
    findall(Where-Texts,
            bagof(Text, fact_text(Facts, Where, Text), Texts),
            Terms),
    forall(member(Term, Terms), write_term_lines(Term)).

fact_text(Facts, Where, Text) :-
    member(Where-What, Facts),
    with_output_to(atom(Text),
                   write_term(What, [quoted(true), priority(999)])).

write_term_lines(Where-[Text|Texts]) :-
    format(atom(Start), 'old(~q, [ ~w', [Where, Text]),
    write(Start),
    atom_length(Start, Column),
    foldl(write_item, Texts, Column, _),
    format(' ]).~n').

write_item(Text, Column0, Column) :-
    atom_length(Text, Length),
    Column1 is Column0 + Length + 2,
    (   Column1 < 94
    ->  Column = Column1,
        format(', ~w', [Text])
    ;   Column is 4 + Length,
        format(',~n    ~w', [Text])
    ).

fact(system, Name/Arity) :-
    predicate_property(system:Head, built_in),
    functor(Head, Name, Arity).
fact(function, Name/Arity) :-
    current_arithmetic_function(Head),
    functor(Head, Name, Arity).
fact(flag, Flag) :-
    current_prolog_flag(Flag, _).
fact(operator, op(Priority, Type, Name)) :-
    current_op(Priority, Type, Name).
fact(module(Module), Predicate) :-      % not for all, but used
    member(Module-Predicate, ['$messages'-translate_message/3]),
    current_predicate(Module:Predicate).
fact(library(Library), Export) :-
    member(Part, ['', 'clp/', 'dcg/', 'http/']),
    atomic_list_concat([Part, '*.pl'], Pattern),
    absolute_file_name(swi(library), Folder, [file_type(directory)]),
    atomic_list_concat([Folder, /, Pattern], Path),
    expand_file_name(Path, Files),
    member(File, Files),
    library_name(Part, File, Library),
    catch(load_files(loaded:File,
                     [if(not_loaded), imports([]), silent(true)]), _, true),
    module_property(Module, file(File)),
    exported(Module, Export).

library_name(Part, File, Library) :-
    file_base_name(File, Base),
    file_name_extension(Name, _, Base),
    (   atom_concat(Folder, /, Part)
    ->  Library = Folder/Name
    ;   Library = Name
    ).

exported(Module, Export) :-
    module_property(Module, exports(Exports)),
    member(Export, Exports).
exported(Module, Operator) :-
    module_property(Module, exported_operators(Operators)),
    member(Operator, Operators).
