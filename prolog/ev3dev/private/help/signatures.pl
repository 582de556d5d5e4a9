:- module(ev3dev_signatures,
          [ form/2,                     % +Predicate, -Form
            arities/2,                  % +Name, -Predicates
            meant/2                     % +Predicate, -Predicates
          ]).
:- use_module('../basics/small_lists', [first_of/3]).
:- use_module('../errors/frames', [is_public/2]).
:- use_module(help_words, [words_for/2]).
:- use_module(libraries, [in_library/2]).

/** <module> Signatures of predicates, and which predicate was meant

For messages. Nothing loads this file before one is needed. It reads the
comments in the files of the libraries.
*/

%!  form(+Predicate, -Form) is semidet.
%
%   Form is how Predicate, a Name/Arity, stands in its comment, without the
%   modes: `motor_run(Port, Speed)`.

form(Name/0, Name) :-
    !.
form(Name/Arity, Form) :-
    atomic_list_concat(['%!  ', Name, '('], Start),
    functor(Head, Name, Arity),
    defined_in(Head, Module),
    module_property(Module, file(File)),
    catch(setup_call_cleanup(open(File, read, In, [encoding(utf8)]),
                             comment(In, Start, Arity, Arguments),
                             close(In)),
          error(_, _), fail),
    !,
    atomic_list_concat(Arguments, ', ', Listed),
    format(atom(Form), '~w(~w)', [Name, Listed]).

defined_in(Head, Module) :-
    (   is_visible(Head, Module0)
    ->  Module = Module0
    ;   current_module(Module),
        sub_atom(Module, 0, _, _, ev3dev),
        predicate_property(Module:Head, exported),
        \+ predicate_property(Module:Head, imported_from(_))
    ->  true
    ).

%   Arguments are those of the first head with Arity arguments. A head may go
%   on in a line that begins with `%`.

comment(In, Start, Arity, Arguments) :-
    repeat,
    read_line(In, Line),
    (   Line == end_of_file
    ->  !,
        fail
    ;   atom_concat(Start, Rest, Line),
        whole(In, Rest, Whole),
        arguments(Whole, Arguments),
        length(Arguments, Arity)
    ),
    !.

read_line(In, Line) :-
    read_line_to_codes(In, Codes),
    (   Codes == end_of_file
    ->  Line = end_of_file
    ;   atom_codes(Line, Codes)
    ).

whole(In, Text, Whole) :-
    (   sub_atom(Text, Before, _, _, ')')
    ->  sub_atom(Text, 0, Before, _, Whole)
    ;   read_line(In, Line),
        atom_concat('%', More, Line),
        atom_concat(Text, More, Text1),
        whole(In, Text1, Whole)
    ).

arguments(Text, Arguments) :-
    atomic_list_concat(Parts, ',', Text),
    plain(Parts, Arguments).

plain([], []).
plain([Part|Parts], [Argument|Arguments]) :-
    atom_codes(Part, Codes0),
    without_mode(Codes0, Codes),
    atom_codes(Argument, Codes),
    plain(Parts, Arguments).

without_mode([Code|Codes0], Codes) :-
    memberchk(Code, ` +-?:@!`),
    !,
    without_mode(Codes0, Codes).
without_mode(Codes, Codes).

%!  arities(+Name, -Predicates) is semidet.
%
%   Predicates are all those of this Name that the user sees and a loaded
%   library of the pack exports, in the order of their arities; else those of
%   libraries that are not loaded, as Library-Predicate.

arities(Name, Predicates) :-
    findall(Arity,
            ( between(0, 6, Arity),
              functor(Head, Name, Arity),
              is_visible(Head, _),
              is_public(_, Name/Arity) ),
            Arities),
    (   Arities \== []
    ->  findall(Name/Arity, member_of(Arities, Arity), Predicates)
    ;   findall(Library-Name/Arity,
                ( in_library(Library, All),
                  member_of(All, Name/Arity) ),
                Predicates),
        Predicates \== []
    ).

%   To ask for a property of what is not known would load view/0.

is_visible(Head, Module) :-
    current_predicate(_, user:Head),
    predicate_property(user:Head, imported_from(Module)),
    sub_atom(Module, 0, _, _, ev3dev).

member_of([X|_], X).
member_of([_|Xs], X) :-
    member_of(Xs, X).

%!  meant(+Predicate, -Predicates) is semidet.
%
%   Predicates, at most six, are those of loaded libraries that Predicate may
%   be meant for: what students call them, else those whose name contains its
%   name, or begins as it does.

meant(Name/_, Predicates) :-
    (   called(Name, Names)
    ->  true
    ;   atom_length(Name, Length),
        Length >= 3,
        findall(Public, alike(Name, Public), Names0),
        sort(Names0, Names)
    ),
    findall(Public/Arity,
            ( member_of(Names, Public),
              arities(Public, All),
              member_of(All, Public/Arity) ),
            Predicates0),
    first_of(4, Predicates0, Predicates),
    Predicates \== [].

alike(Name, Public) :-
    current_module(Module),
    sub_atom(Module, 0, _, _, ev3dev),
    module_property(Module, exports(Exports)),
    member_of(Exports, Public/Arity),
    (   sub_atom(Public, _, _, _, Name)
    ->  true
    ;   sub_atom(Name, 0, 6, _, Start),
        sub_atom(Public, 0, _, _, Start)
    ),
    functor(Head, Public, Arity),
    is_visible(Head, _).

%   What other languages and people call it: the word, or a part of it, as in
%   `turn_left`.

called(Word, Names) :-
    atomic_list_concat(Parts, '_', Word),
    member_of([Word|Parts], Part),
    words_for(Words, Names),
    memberchk(Part, Words),
    !.
