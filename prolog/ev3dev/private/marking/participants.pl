:- module(ev3dev_marking_participants,
          [ read_participants/2,        % +File, -Participants
            with_participants/4,        % +Participants, +Submissions0,
                                        % -Submissions, -Strangers
            worksheet/2,                % +Participants, -Columns
            grade_number/2              % +Text, -Number
          ]).
:- use_module(submissions, [decoded/2]).
:- use_module('../errors/errors', [in_own_name/1, throw_error/3]).
:- use_module(library(csv), [csv//2]).
:- use_module(library(lists), [append/3, last/2, member/2, nth1/3]).
:- use_module(library(readutil), [read_file_to_string/3]).

/** <module> The list of a class

A list is a table with commas, semicolons or tabs, as a learning platform or a
spreadsheet writes it: participants(Header, Rows). Its columns may have any
names and order. A row belongs to a submission if one of its cells, or its
first two together, is the student's name, user, number or address, or if a
cell such as `Participant 12` ends with Moodle's number.
*/

%!  read_participants(+File, -Participants) is det.
%
%   @error existence_error(source_sink, File)
%   @error domain_error(participants, File) if it has no rows

read_participants(File, participants(Header, Rows)) :-
    in_own_name(read_file_to_string(File, Octets, [encoding(octet)])),
    decoded(Octets, Text),
    string_codes(Text, Codes),
    separator(Text, Separator),
    (   catch(phrase(csv(Found, [ separator(Separator), convert(false),
                                  match_arity(false) ]), Codes), _, fail),
        findall(Cells, ( member(Row, Found), Row =.. [_|Cells] ),
                [Header|Rows0]),
        findall(Cells,
                ( member(Cells, Rows0), \+ Cells = [''] ),
                [Row1|Rest])
    ->  Rows = [Row1|Rest]
    ;   format(atom(Text1),
               '~w must be a table with a heading and a row for each student',
               [File]),
        throw_error(domain_error(participants, File), _, Text1)
    ).

%   The one that is most frequent in the first line.

separator(Text, Separator) :-
    split_string(Text, "\n", "", [Line|_]),
    findall(Count-Code,
            ( member(Code, [0'\t, 0';, 0',]),
              char_code(Char, Code),
              findall(x, sub_string(Line, _, _, _, Char), All),
              length(All, Count) ),
            Counted0),
    keysort(Counted0, Counted),
    last(Counted, _-Separator).

%!  with_participants(+Participants, +Submissions0, -Submissions, -Strangers)
%!      is det.
%
%   Each submission gets the key row(N) of its row. For each row without one
%   there is a submission that is refused. Strangers are the names that are in
%   no row.

with_participants(participants(_, Rows), Submissions0, Submissions,
                  Strangers) :-
    findall(One-How, ( member(One0, Submissions0),
                       matched(One0, Rows, One, How) ), Pairs),
    findall(N, ( member(submission(_, Keys, _, _)-_, Pairs),
                 memberchk(row(N), Keys) ), Found),
    findall(Name,
            ( member(submission(Name, Keys, _, _)-_, Pairs),
              \+ memberchk(row(_), Keys) ),
            Strangers),
    naming_column(Pairs, Rows, How),
    findall(submission(Name, [row(N)], [], 'Nothing was handed in.'),
            ( nth1(N, Rows, Row),
              \+ memberchk(N, Found),
              once(( cell(Row, How, Name) ; member(Name, Row) )) ),
            Absent),
    findall(One, member(One-_, Pairs), Present),
    append(Present, Absent, Submissions).

%   The column of the other names; in a worksheet the second, unless it has no
%   names, since the students are anonymous.

naming_column(Pairs, Rows, How) :-
    (   member(_-cell(How), Pairs)
    ->  true
    ;   member(_-number, Pairs),
        findall(Name, member([_, Name|_], Rows), Names),
        sort(Names, Sorted),
        length(Names, Count),
        length(Sorted, Count)
    ->  How = 2
    ;   How = 1
    ).

matched(Submission0, Rows, Submission, How) :-
    Submission0 = submission(Name, Keys, Files, Refused),
    findall(Low,
            ( member(Key, [Name|Keys]),
              \+ Key = id(_),
              ( compound(Key) -> arg(1, Key, Text) ; Text = Key ),
              downcase_atom(Text, Low) ),
            Names),
    (   nth1(N, Rows, Row),
        \+ ( member(id(Id), Keys), other_number(Row, Id) ),
        cell(Row, How0, Cell),
        downcase_atom(Cell, Low),
        memberchk(Low, Names)
    ->  How = cell(How0),
        Submission = submission(Name, [row(N)|Keys], Files, Refused)
    ;   member(id(Id), Keys),
        nth1(N, Rows, [First|_]),
        number_at_end(First, Id)
    ->  How = number,
        Submission = submission(Name, [row(N)|Keys], Files, Refused)
    ;   nth1(N, Rows, Row),
        member(Cell, Row),
        Cell \== '',
        \+ atom_number(Cell, _),
        atom_concat(-, Cell, End),
        atom_concat(_, End, Name)
    ->  How = user,
        Submission = submission(Name, [row(N), user(Cell)|Keys], Files,
                                Refused)
    ;   How = none,
        Submission = Submission0
    ).

%   cell(Row, How, Text): How is the number of a cell, or both in an order.

cell(Row, N, Cell) :-
    \+ atom(N),
    nth1(N, Row, Cell0),
    normalize_space(atom(Cell), Cell0),
    Cell \== ''.
cell([A, B|_], How, Cell) :-
    member(How-Parts, [first_last-[A, B], last_first-[B, A]]),
    atomic_list_concat(Parts, ' ', Cell).

%   Participant 12, in any language; another row has another number.

number_at_end(Cell, Id) :-
    atom_concat(Word, Id, Cell),
    Word \== '',
    \+ ( sub_atom(Word, _, 1, _, Char), char_type(Char, digit) ).

other_number([First|_], Id) :-
    atom_codes(First, Codes),
    append(Word, [Digit|Digits], Codes),
    code_type(Digit, digit),
    !,
    Word \== [],
    atom_codes(Number, [Digit|Digits]),
    Number \== Id.

%!  worksheet(+Participants, -Columns) is semidet.
%
%   True if this is Moodle's grading worksheet. Columns is
%   columns(Grade, Most, Feedback), the numbers of its columns. Their names
%   depend on the language, but not their order: the identifier is the first,
%   the grade stands before its maximum, and comments are the last
%   (mod/assign/gradingtable.php of Moodle 4).

worksheet(participants(Header, Rows), columns(Grade, Most, Feedback)) :-
    \+ ( member([First|_], Rows),
         \+ ( atom_codes(First, Codes),
              last(Codes, Last),
              code_type(Last, digit),
              Codes = [Letter|_],
              code_type(Letter, alpha) ) ),
    (   nth1(Grade, Header, 'Grade'),
        nth1(Most, Header, 'Maximum grade'),
        nth1(Feedback, Header, 'Feedback comments')
    ->  true
    ;   nth1(Most, Header, _),
        Most > 2,
        Rows = [Row|_],
        nth1(Most, Row, Same),
        grade_number(Same, _),
        \+ ( member(Other, Rows), \+ nth1(Most, Other, Same) )
    ->  Grade is Most-1,
        length(Header, Feedback)
    ).

%!  grade_number(+Text, -Number) is semidet.
%
%   Text has a point or a comma.

grade_number(Text, Number) :-
    atomic_list_concat(Parts, ',', Text),
    atomic_list_concat(Parts, '.', Plain),
    atom_number(Plain, Number).
