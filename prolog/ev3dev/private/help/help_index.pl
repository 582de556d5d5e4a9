:- module(ev3dev_help_index,
          [ asked/1,                    % +Question
            load_help/2,                % :File, +Options
            answer_first/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(library(lists), [append/3, member/2, nth1/3]).
:- use_module(libraries, [in_library/2, pack_file/2]).
:- use_module(help_words, [words_for/2]).

:- meta_predicate load_help(:, +).

:- multifile prolog:message//1.

/** <module> The comments of the pack's predicates, for help/1 and apropos/1

At the first question the comments are read from the files of all libraries,
loaded or not. Prolog's own help/1 would find only those of loaded libraries,
and print one that is about several predicates several times. This one needs
neither library(pldoc) nor a pager.
*/

:- if((current_prolog_flag(version, Version), Version >= 80200)).

%   Loading it calls the hook that calls this, again.
:- thread_local loading/0.

%!  load_help(:File, +Options) is semidet.
%
%   Load File, which is library(help), and let the pack answer before it.

load_help(File, Options) :-
    \+ loading,
    setup_call_cleanup(assertz(loading),
                       load_files(File, Options),
                       retractall(loading)),
    answer_first.

%!  answer_first is det.
%
%   From now on the pack answers help/1 and apropos/1 first.

answer_first :-
    (   current_module(prolog_help)
    ->  wrap_predicate(prolog_help:help(What), ev3dev, Help,
                       ev3dev_help_index:answers(help(What), Help)),
        wrap_predicate(prolog_help:apropos(Query), ev3dev, Apropos,
                       ev3dev_help_index:answers(apropos(Query), Apropos))
    ;   true
    ).

%   answers(+Question, :Prolog)
%
%   Answer Question. If the pack cannot, call Prolog, its own answer. Matches
%   of its manual are printed after those of the pack.

answers(Question, Prolog) :-
    (   \+ asked(Question)
    ->  call(Prolog)
    ;   Question = apropos(_)
    ->  setup_call_cleanup(assertz(further),
                           ignore(Prolog),
                           retractall(further))
    ;   true
    ).

%   That there are no further matches is not said.
:- thread_local further/0.

:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

user:message_hook(help(no_apropos_match(_)), _, _) :-
    ev3dev_help_index:further.

:- else.

load_help(_, _) :-
    fail.

answer_first.

:- endif.

%   comment_(Id, Library, Heads, Body): Library is `ev3dev`, `ev3dev/drive`
%   or the like. Heads and Body are lists of strings: lines.
%   predicate_(Name, Arity, Id)
%   fact_(Id): a library asks for it, and the user's file defines it
%   words_(Id, Names, LibraryWords, SummaryWords): what apropos/1 looks at
:- dynamic
    comment_/4,
    predicate_/3,
    fact_/1,
    words_/4.
:- volatile
    comment_/4,
    predicate_/3,
    fact_/1,
    words_/4.

% ---------------- QUESTIONS

%!  asked(+Question) is semidet.
%
%   Print the answer to `help(What)` or `apropos(Query)`. Fails, and prints
%   nothing, if the pack has no answer.
%
%   What is Name, Name/Arity, or Library:Name/Arity as apropos/1 prints it.
%   Query is a text, or Type:Text, where Type begins `predicate`. All words
%   have to be those of a predicate: parts of its name, words of
%   `help_words.pl`, its library, or words of the first sentence of its
%   comment. Their beginnings will do. Names and words in `help_words.pl` come
%   before others.

asked(help(What)) :-
    named(What, Library, Name, Arity),
    read_comments,
    findall(Later-Id,
            ( predicate_(Name, Arity, Id),
              comment_(Id, Library, _, _),
              later(Library, Later) ),
            Found),
    Found \== [],
    sort(Found, Sorted),
    print_comments(Sorted, none).
asked(apropos(Query)) :-
    tokens(Query, Tokens),
    Tokens \== [],
    read_comments,
    findall(Key-found(Id, Name),
            ( comment_(Id, Library, _, _),
              rank(Tokens, Id, Rank, Name),
              later(Library, Later),
              Key is Later - 10*Rank ),
            Found),
    Found \== [],
    keysort(Found, Sorted),
    print_message(help, ev3dev(matches(Sorted))).

named(What, _, _, _) :-
    var(What),
    !,
    fail.
named(Where:What, Library, Name, Arity) :-
    !,
    ground(Where),
    format(atom(Library), '~w', [Where]),
    named(What, _, Name, Arity).
named(Name/Arity, _, Name, Arity) :-
    !,
    atom(Name).
named(Name, _, Name, _) :-
    atom(Name).

%   What is loaded already comes first.

later(Library, Later) :-
    (   Library == ev3dev
    ->  Later = 0
    ;   Later = 1
    ).

% ---------------- MATCHES

tokens(Query, Tokens) :-
    (   nonvar(Query),
        Query = Type:Text
    ->  atom(Type),
        downcase_atom(Type, Prefix),
        member(Class, [predicate, library_predicate]),
        sub_atom(Class, 0, _, _, Prefix),
        !
    ;   Text = Query
    ),
    text(Text),
    words_of(Text, Words),
    findall(Token, ( member(Word, Words), token(Word, Token) ), Tokens).

%   A token is token(Forms, Described): the forms of a word, and the names of
%   what they describe, Name-Rank.

token(Word, token(Forms, Described)) :-
    findall(Form, form(Word, Form), Forms),
    findall(Name-Rank,
            ( words_for(Words, Names),
              member(Form, Forms),
              memberchk(Form, Words),
              nth1(Number, Names, Name),
              Rank is 95 - min(Number, 25) ),
            Described).

text(Text) :-
    (   atom(Text)
    ->  true
    ;   string(Text)
    ).

words_of(Text, Words) :-
    string_lower(Text, Lower),
    split_string(Lower, " \t\n,.;:!?()|`'\"/-", "", Parts),
    findall(Word,
            ( member(Part, Parts), Part \== "", atom_string(Word, Part) ),
            Words).

%   The word as it is, without an ending, and in American spelling

form(Word, Word).
form(Word, Stem) :-
    member(Ending-Instead, [s-'', es-'', ing-'', ing-e, ed-'', ed-e]),
    atom_concat(Base, Ending, Word),
    atom_length(Base, Length),
    Length >= 3,
    atom_concat(Base, Instead, Stem).
form(Word, American) :-
    member(British-Instead, [our-or, ours-or, re-er, res-er]),
    atom_concat(Base, British, Word),
    atom_concat(Base, Instead, American).

%   rank(+Tokens, +Id, -Rank, -Name)
%
%   True if each of Tokens is found with the comment Id. Name is that of its
%   predicates which answers best.

rank(Tokens, Id, Rank, Name) :-
    words_(Id, Names, LibraryWords, SummaryWords),
    ranks(Tokens, in(Names, LibraryWords, SummaryWords), Ranks),
    sum_ranks(Ranks, 0, Rank),
    keysort(Ranks, Sorted),
    append(_, [_-Name], Sorted),
    !.

ranks([], _, []).
ranks([Token|Tokens], Where, [Rank-Name|Ranks]) :-
    findall(Key-Name0,
            ( found(Token, Where, Rank0, Name0),
              Key is -Rank0 ),
            All),
    keysort(All, [Key-Name|_]),
    Rank is -Key,
    ranks(Tokens, Where, Ranks).

sum_ranks([], Sum, Sum).
sum_ranks([Rank-_|Ranks], Sum0, Sum) :-
    Sum1 is Sum0 + Rank,
    sum_ranks(Ranks, Sum1, Sum).

found(token(_, Described), in(Names, _, _), Rank, Name) :-
    member(Name-Rank, Described),
    memberchk(Name, Names).
found(token(Forms, _), in(Names, LibraryWords, SummaryWords), Rank, Name) :-
    nth1(Number, Forms, Form),
    found_form(Form, Names, LibraryWords, SummaryWords, Rank0, Name),
    % another form than that of the query is not as good
    Rank is Rank0 - min(Number, 2).

found_form(Form, Names, _, _, Rank, Name) :-
    member(Name, Names),
    in_name(Form, Name, Rank).
found_form(Form, [Name|_], LibraryWords, _, 50, Name) :-
    memberchk(Form, LibraryWords).
found_form(Form, [Name|_], _, SummaryWords, Rank, Name) :-
    member(Word, SummaryWords),
    begins(Form, Word, 40, 30, Rank).

in_name(Form, Name0, Rank) :-
    downcase_atom(Name0, Name),
    in_lower_name(Form, Name, Rank).

in_lower_name(Name, Name, 100) :-
    !.
in_lower_name(Form, Name, Rank) :-
    atomic_list_concat(Parts, '_', Name),
    member(Part, Parts),
    begins(Form, Part, 68, 60, Rank).
in_lower_name(Form, Name, 55) :-
    atom_length(Form, Length),
    Length >= 4,
    sub_atom(Name, _, _, _, Form),
    !.

begins(Word, Word, Rank, _, Rank) :-
    !.
begins(Form, Word, _, Rank, Rank) :-
    atom_length(Form, Length),
    Length >= 3,
    sub_atom(Word, 0, _, _, Form).

%   The first sentence

summary(Body, Summary) :-
    paragraph(Body, Lines),
    atomic_list_concat(Lines, ' ', Text),
    (   sub_atom(Text, Before, _, After, '. '),
        sub_atom(Text, _, After, 0, Next),
        sub_atom(Next, 0, 1, _, Char),
        char_type(Char, upper)
    ->  Length is Before + 1,
        sub_atom(Text, 0, Length, _, Summary)
    ;   Summary = Text
    ).

paragraph([Line|Lines], Paragraph) :-
    (   Line == ""
    ->  Paragraph = []
    ;   Paragraph = [Line|Paragraph1],
        paragraph(Lines, Paragraph1)
    ).
paragraph([], []).

% ---------------- PRINTING

%   print_comments(+Pairs, +Library)
%
%   Library is that of the comment before.

print_comments([], _).
print_comments([_-Id|Pairs], Before) :-
    comment_(Id, Library, Heads, Body),
    (   Library == Before
    ->  true
    ;   print_library(Library, Id)
    ),
    print_lines(Heads, '  '),
    nl,
    print_lines(Body, '    '),
    nl,
    print_comments(Pairs, Library).

print_library(Library, Id) :-
    (   fact_(Id)
    ->  How = ', in a file of your own'
    ;   is_imported(Library, Id)
    ->  How = ''
    ;   atomic_list_concat([', which is not loaded: use_module(library(',
                            Library, ')).'], How)
    ),
    format('library(~w)~w~n~n', [Library, How]).

is_imported(ev3dev, _) :-
    !.
is_imported(_, Id) :-
    predicate_(Name, Arity, Id),
    functor(Head, Name, Arity),
    current_predicate(_, user:Head),    % a property alone would load view/0
    predicate_property(user:Head, imported_from(_)),
    !.

print_lines([], _).
print_lines([Line|Lines], Indent) :-
    (   Line == ""
    ->  nl
    ;   format('~w~w~n', [Indent, Line])
    ),
    print_lines(Lines, Indent).

prolog:message(ev3dev(matches(Pairs))) -->
    { most(Most),
      length(Pairs, Count),
      findall(Object-Summary,
              ( nth1(Number, Pairs, _-found(Id, Name)),
                Number =< Most,
                object(Id, Name, Object, Summary) ),
              Lines),
      widest(Lines, 0, Widest),
      width(Width)
    },
    match_lines(Lines, Widest, Width),
    (   { Count > Most }
    ->  { More is Count - Most },
        [ nl, '~d more: add a word, as in apropos(\'stop motor\').'-[More] ]
    ;   []
    ).

most(20).

width(Width) :-
    (   catch(tty_size(_, Width0), error(_, _), fail)
    ->  Width is max(60, Width0)
    ;   Width = 80
    ).

%   As in `ev3dev/drive:go_to/1,2,3,4`

object(Id, Name, Object, Summary) :-
    comment_(Id, Library, _, Body),
    findall(Arity, predicate_(Name, Arity, Id), Arities0),
    sort(Arities0, Arities),
    atomic_list_concat(Arities, ',', ArityList),
    atomic_list_concat([Library, :, Name, /, ArityList], Object),
    summary(Body, Summary).

widest([], Widest, Widest).
widest([Object-_|Lines], Widest0, Widest) :-
    atom_length(Object, Length),
    Widest1 is min(36, max(Widest0, Length)),
    widest(Lines, Widest1, Widest).

match_lines([], _, _) -->
    [].
match_lines([Object-Summary|Lines], Widest, Width) -->
    { atom_length(Object, Length),
      Gap is max(0, Widest - Length) + 2,
      Room is Width - Length - Gap - 1,
      shortened(Summary, Room, Text)
    },
    [ '~w~*c~w'-[Object, Gap, 32, Text] ],
    (   { Lines == [] }
    ->  []
    ;   [ nl ]
    ),
    match_lines(Lines, Widest, Width).

shortened(Text, Room, Short) :-
    atom_length(Text, Length),
    (   Length =< Room
    ->  Short = Text
    ;   Room < 5
    ->  Short = ''
    ;   Kept is Room - 4,
        sub_atom(Text, 0, Kept, _, Begin),
        atom_concat(Begin, ' ...', Short)
    ).

% ---------------- READING

read_comments :-
    predicate_(_, _, _),
    !.
read_comments :-
    with_mutex(ev3dev_help_index, read_comments_once).

read_comments_once :-
    predicate_(_, _, _),
    !.
read_comments_once :-
    forall(( pack_file(Folder, File), exports(File, Exports) ),
           read_file(Folder, File, Exports)).

%   A predicate that a public library takes from another file has its comment
%   there. Each file of planners is a library for itself.

read_file(Folder, File, Exports) :-
    (   ( Folder == '' ; sub_atom(Folder, 0, _, _, private) )
    ->  Offer = offer(none, [])
    ;   file_base_name(File, Base),
        file_name_extension(Stem, _, Base),
        atomic_list_concat([ev3dev, /, Folder, /, Stem], Library),
        Offer = offer(Library, Exports)
    ),
    setup_call_cleanup(
        open(File, read, In, [encoding(utf8)]),
        read_string(In, _, Text),
        close(In)),
    split_string(Text, "\n", "", Lines),
    forall(comment(Lines, Heads, Body),
           add_comment(Offer, Heads, Body)),
    (   Folder == ''
    ->  forall(fact(Lines, Head, Body), add_fact(File, Head, Body))
    ;   true
    ).

%   Files of worlds and robots are no modules.

exports(File, Exports) :-
    setup_call_cleanup(
        open(File, read, In, [encoding(utf8)]),
        read(In, First),
        close(In)),
    First = (:- module(_, Exports)).

%   comment(+Lines, -Heads, -Body)
%
%   True if Lines have a comment of predicates. Heads are its lines about how
%   they are called, without `%`; those of a new head begin with `!`.

comment(Lines, Heads, Body) :-
    append(_, [Line|Lines1], Lines),
    sub_string(Line, 0, 2, _, "%!"),
    heads([Line|Lines1], Heads, Lines2),
    body(Lines2, Body).

%   fact(+Lines, -Head, -Body)
%
%   True if a section about facts has an item for Head in Lines.

fact(Lines, Head, Body) :-
    append(_, [Heading|Lines1], Lines),
    string_concat("## ", _, Heading),
    sub_string(Heading, _, _, 0, "-facts}"),
    section(Lines1, Section),
    append(_, [Item|Lines2], Section),
    string_concat("  - ", Head, Item),
    item(Lines2, Body).

section([Line|Lines], Section) :-
    (   \+ sub_string(Line, 0, _, _, "## "),
        Line \== "*/"
    ->  Section = [Line|Section1],
        section(Lines, Section1)
    ;   Section = []
    ).

item([Line|Lines], Body) :-
    (   Line == ""
    ->  Body = [""|Body1]
    ;   string_concat("    ", Text, Line)
    ->  Body = [Text|Body1]
    ),
    !,
    item(Lines, Body1).
item(_, []).

heads([Line|Lines], [Text|Heads], Rest) :-
    string_concat("%", Text, Line),
    split_string(Text, "", " ", [Stripped]),
    Stripped \== "",
    !,
    heads(Lines, Heads, Rest).
heads(Rest, [], Rest).

body(Lines, Body) :-
    body(Lines, "", Body).

%   Code stands between two fences, and is printed further to the right.

body([Line|Lines], Indent, Body) :-
    string_concat("%", Text0, Line),
    \+ sub_string(Text0, 0, 1, _, "!"),
    !,
    (   string_concat("   ", Text1, Text0)
    ->  true
    ;   Text1 = Text0
    ),
    (   Text1 \== "```"
    ->  tag_word(Text1, Text2),
        string_concat(Indent, Text2, Text),
        Body = [Text|Body1],
        body(Lines, Indent, Body1)
    ;   Indent == ""
    ->  body(Lines, "  ", Body)
    ;   body(Lines, "", Body)
    ).
body(_, _, []).

tag_word(Text0, Text) :-
    (   tag(Tag, Word),
        string_concat(Tag, Rest, Text0)
    ->  string_concat(Word, Rest, Text)
    ;   Text = Text0
    ).

tag("@error ", "Error: ").
tag("@throws ", "Error: ").
tag("@see ", "See: ").

%   A comment is kept if it is about a predicate that a library offers. Public
%   files are read first.

add_comment(Offer, Heads, Body0) :-
    atomic_list_concat(Heads, ' ', All),
    atomic_list_concat([_|Texts], '!', All),
    findall(PI, ( member(Text, Texts), head_indicator(Text, PI) ), PIs),
    (   member(PI, PIs),
        offered(PI, Offer, Library),
        \+ known(PI, Library)
    ->  without_ends(Body0, Body),
        flag(ev3dev_help_index, Id, Id + 1),
        printed(Heads, Printed),
        assertz(comment_(Id, Library, Printed, Body)),
        forall(member(PI1, PIs), add_predicate(PI1, Id)),
        add_words(Id, Library, Body)
    ;   true
    ).

add_fact(File, Head, Body0) :-
    file_base_name(File, Base),
    file_name_extension(Stem, _, Base),
    atom_concat('ev3dev/', Stem, Library),
    head_indicator(Head, PI),
    without_ends(Body0, Body),
    flag(ev3dev_help_index, Id, Id + 1),
    assertz(comment_(Id, Library, [Head], Body)),
    assertz(fact_(Id)),
    add_predicate(PI, Id),
    add_words(Id, Library, Body).

%   A comment may have several heads for one predicate.

add_predicate(Name/Arity, Id) :-
    (   predicate_(Name, Arity, Id)
    ->  true
    ;   assertz(predicate_(Name, Arity, Id))
    ).

add_words(Id, Library, Body) :-
    findall(Name, predicate_(Name, _, Id), Names),
    atomic_list_concat([_|LibraryWords], /, Library),
    summary(Body, Summary),
    words_of(Summary, SummaryWords),
    assertz(words_(Id, Names, LibraryWords, SummaryWords)).

known(Name/Arity, Library) :-
    predicate_(Name, Arity, Id),
    comment_(Id, Library, _, _).

offered(PI, offer(File, Exports), Library) :-
    (   module_property(ev3dev, exports(Offered)),
        memberchk(PI, Offered)
    ->  Library = ev3dev
    ;   in_library(Library0, Offered),
        memberchk(PI, Offered)
    ->  atom_concat('ev3dev/', Library0, Library)
    ;   memberchk(PI, Exports),
        Library = File
    ).

%   Modes are operators, as in `until(:Condition, :Goal)`.
:- op(650, fx, ev3dev_help_modes:(:)).
:- op(650, fx, ev3dev_help_modes:(?)).
:- op(650, fx, ev3dev_help_modes:(@)).

head_indicator(Text, Name/Arity) :-
    (   sub_atom(Text, Before, _, _, ' is ')
    ->  sub_atom(Text, 0, Before, _, Head)
    ;   Head = Text
    ),
    catch(read_term_from_atom(Head, Term, [module(ev3dev_help_modes)]),
          error(_, _), fail),
    callable(Term),
    functor(Term, Name, Arity).

printed([], []).
printed([Head|Heads], [Line|Lines]) :-
    (   string_concat("!", Text, Head)
    ->  true
    ;   Text = Head
    ),
    split_string(Text, "", " ", [Line]),
    printed(Heads, Lines).

without_ends(Lines0, Lines) :-
    (   Lines0 = [""|Lines1]
    ->  without_ends(Lines1, Lines)
    ;   append(Lines1, [""], Lines0)
    ->  without_ends(Lines1, Lines)
    ;   Lines = Lines0
    ).
