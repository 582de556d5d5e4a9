% Checks over the pack's Prolog files; run by `make lint`.

% The comments of what is loaded are kept from here on; so it is read from its sources.
:- use_module(library(pldoc)).
:- use_module(library(pldoc/doc_process)).
:- doc_collect(true).

:- use_module(trees).
:- use_module(papers).
:- use_module(library(ev3dev/private/help/libraries)).
:- use_module(library(ev3dev/private/journal/fenced_log)).
:- use_module(library(check)).
:- use_module(library(prolog_xref)).

:- dynamic complaint/0.

main :-
    self_test,
    load_all,
    check,
    forall(undocumented(Module, PI), complain(undocumented(Module:PI))),
    forall(( source(File), bad_line(File, Line, Why) ), complain(line(File, Line, Why))),
    forall(without_partner(File), complain(no_test_or_no_module(File))),
    forall(( prose(File, Line, Text), banned_in(Text, Word) ),
           complain(line(File, Line, banned(Word)))),
    forall(( comment(File, Line, Text), unplain(Text, Word) ),
           complain(line(File, Line, unplain(Word)))),
    forall(untrue(Complaint), complain(Complaint)),
    (   complaint
    ->  halt(1)
    ;   halt(0)
    ).

% No goal of this file calls what they export.
load_all :-
    forall(( ev3dev_libraries:pack_file(Folder, File),
             \+ memberchk(Folder, [worlds, robots]) ),
           load_files(File, [if(not_loaded), imports([])])).

complain(What) :-
    assertz(complaint),
    print_message(error, format("~p", [What])).

% Warnings of check/0 count, too.
user:message_hook(_, Kind, _) :-
    memberchk(Kind, [warning, error]),
    assertz(complaint),
    fail.

library_module(Module) :-
    current_module(Module),
    sub_atom(Module, 0, _, _, ev3dev),
    module_property(Module, file(_)).

%!  undocumented(-Module, -PI) is nondet.
%
%   An export without a PlDoc comment in the module that defines it. Those of
%   native predicates have theirs in src/, see tools/natives.py.

undocumented(Module, Name/Arity) :-
    library_module(Module),
    Module \== ev3dev_native,
    module_property(Module, exports(Exports)),
    member(Name/Arity, Exports),
    functor(Head, Name, Arity),
    \+ predicate_property(Module:Head, imported_from(_)),
    \+ doc_comment(Module:Name/Arity, _, _, _),
    Less is Arity-2,
    \+ doc_comment(Module:Name//Less, _, _, _).

%!  without_partner(-File) is nondet.
%
%   A public module has a test file of its name, and the other way round: what
%   is about no single module is in tests/behavior. The tests of golog.pl may
%   be in several files, such as test_golog.pl and test_golog_robot.pl.

without_partner(File) :-
    named('prolog/ev3dev/*.pl', '', Name, File),
    \+ named('tests/prolog/*.pl', test_, Name, _).
without_partner(File) :-
    named('tests/prolog/*.pl', test_, Name, File),
    \+ ( named('prolog/ev3dev/*.pl', '', Module, _),
         ( Name == Module
         ; atom_concat(Module, '_', Begin), sub_atom(Name, 0, _, _, Begin)
         ) ).

named(Pattern, Prefix, Name, File) :-
    expand_file_name(Pattern, Files),
    member(File, Files),
    file_base_name(File, Base),
    file_name_extension(Stem, _, Base),
    atom_concat(Prefix, Name, Stem).

source('pack.pl').
source(File) :-
    member(Folder, [prolog, examples, app]),
    directory_member(Folder, File, [extensions([pl]), recursive(true)]).

% A line of a page, and the comment in a line of Rust or of a test.
prose(File, Number, Line) :-
    member(Pattern, ['README.md', 'docs/*.md']),
    expand_file_name(Pattern, Files),
    member(File, Files),
    line_of(File, Number, Line).
prose(File, Number, Comment) :-
    member(Folder-Extension-Mark,
           [src-rs-"//", crates-rs-"//", tests-pl-"%"]),
    directory_member(Folder, File, [extensions([Extension]), recursive(true)]),
    line_of(File, Number, Line),
    once(sub_string(Line, Before, _, _, Mark)),
    sub_string(Line, Before, _, 0, Comment).

%!  comment(-File, -Number, -Text) is nondet.
%
%   Text is a line of a paper, or of a comment of the pack's own files. If a
%   comment begins in it, it begins with a caret.

comment(File, Number, Text) :-
    member(Pattern, ['README.md', 'docs/*.md', 'docs/*/*.md', 'course/*/*.md']),
    expand_file_name(Pattern, Files),
    member(File, Files),
    line_of(File, Number, Text).
comment(File, Number, Text) :-
    member(Folder-Extension-Mark,
           [ prolog-pl-"%", examples-pl-"%", course-pl-"%", app-pl-"%", tests-pl-"%",
             src-rs-"//", crates-rs-"//" ]),
    directory_member(Folder, File, [extensions([Extension]), recursive(true)]),
    read_file_to_string(File, All, []),
    split_string(All, "\n", "", Lines),
    nth1(Number, [""|Lines], Before),
    nth1(Number, Lines, Line),
    comment_of(Line, Mark, Text0),
    (   comment_of(Before, Mark, _)
    ->  Text = Text0
    ;   string_concat("^", Text0, Text)
    ).

% What follows the Mark at the beginning of a Line.
comment_of(Line, Mark, Text) :-
    split_string(Line, "", " ", [Line1]),
    string_concat(Mark, Line2, Line1),
    split_string(Line2, "", "%/! ", [Text]).

%!  unplain(+Text, -Word) is nondet.
%
%   True if Text begins a comment as a fragment, or has a Word that the
%   glossary of CONTRIBUTING.md replaces. A name such as `tell(Closure)` is no
%   such word.

unplain(Text, Word) :-
    member(Word, ["Which ", "Which.", "That of ", "Those of ", "At its ",
                  "Who ", "So much", "So many", "So long", "So often"]),
    string_concat("^", Word, Start),
    string_concat(Start, _, Text).
unplain(Text, Word) :-
    split_string(Text, " ", ".,:;()", Words),
    member(Word, ["told", "tell", "tells", "telling"]),
    memberchk(Word, Words),
    \+ sub_string(Text, _, _, _, "- tell("),
    \+ sub_string(Text, _, _, _, "- told(").

bad_line(File, Number, Why) :-
    line_of(File, Number, Line),
    (   bad(Line, Why)
    ;   sub_atom(File, 0, _, _, 'prolog/'),
        nameless(Line, Why)
    ).

% A record with many fields has names for them: private/basics/fields.pl.
nameless(Line, four_nameless_arguments) :-
    split_string(Line, "%", "", [Code|_]),
    split_string(Code, " ", " ", Words),
    atomic_list_concat(Words, Packed),
    sub_atom(Packed, Before, _, _, '_,_,_,_'),
    \+ ( Last is Before-1,
         sub_atom(Packed, Last, 1, _, Char),
         char_type(Char, csym) ).
nameless(Line, argument(Number)) :-
    \+ sub_string(Line, 0, _, _, "%"),
    sub_string(Line, Before, _, After, "arg("),
    Begin is Before+4,
    sub_string(Line, Begin, After, 0, Rest),
    split_string(Rest, ",", "", [Digits, _|_]),
    number_string(Number, Digits),
    Number > 1.

line_of(File, Number, Line) :-
    read_file_to_string(File, Text, []),
    split_string(Text, "\n", "", Lines),
    nth1(Number, Lines, Line).

bad(Line, tab) :-
    sub_string(Line, _, _, _, "\t").
bad(Line, trailing_space) :-
    sub_string(Line, _, 1, 0, " ").
bad(Line, of(Length, characters, most(78))) :-
    string_length(Line, Length),
    Length > 78.
bad(Line, banned(Word)) :-
    banned_in(Line, Word).

%!  banned_in(+Line, -Word) is nondet.
%
%   True if Line uses a banned Word: one that CONTRIBUTING.md replaces, or one
%   in British spelling. A name such as `grid_center` is a word of its own.

banned_in(Line, Word) :-
    string_lower(Line, Lower),
    banned(Word),
    sub_string(Lower, Before, _, After, Word),
    \+ continues(Lower, Before, -1),
    string_length(Lower, Length),
    Next is Length - After,
    \+ continues(Lower, Next, 0),
    \+ excused(Word, Lower, Before).

% A letter or an underscore stands there.
continues(Line, Position, Offset) :-
    Index is Position + Offset,
    Index >= 0,
    sub_string(Line, Index, 1, _, Char),
    char_type(Char, csym).

banned("anew").
banned("is none").
banned("are none").
banned("so many").
banned("whoever").
banned(Word) :-
    member(Stem, ["colour", "metre", "centimetre", "millimetre", "centre",
                  "neighbour", "behaviour", "recognise", "tyre"]),
    member(Ending, ["", "s", "d"]),
    string_concat(Stem, Ending, Word).
banned("coloured").
banned("grey").
banned("greys").
banned("licence").
banned("cancelled").

% "if there is none" is plain English.
excused(Word, Line, Before) :-
    memberchk(Word, ["is none", "are none"]),
    sub_string(Line, 0, Before, _, Start),
    sub_string(Start, _, _, 0, "there ").

% The check of words can fail, and does not fail on good words.
self_test :-
    forall(( member(Bad, [ "Plans anew.", "for an option that is none",
                           "an actuator, in millimetres", "led(?Light, ?Colour)",
                           "the centre, whoever asks", "So many times" ]),
             \+ banned_in(Bad, _)
           ),
           complain(not_found(Bad))),
    forall(( member(Bad, [ "^Which there are.", "^That of the rule",
                           "which the page is told" ]),
             \+ unplain(Bad, _)
           ),
           complain(not_found(Bad))),
    forall(( member(Good, [ "Which there are", "- tell(:Closure)",
                            "^Whose turn it is" ]),
             unplain(Good, Word)
           ),
           complain(found(Word, Good))),
    forall(( member(Good, [ "fails if there is none", "set_grid([neighbors(8)])",
                            "in centimeters", "a_grey_name", "the center" ]),
             banned_in(Good, Word)
           ),
           complain(found(Word, Good))).
