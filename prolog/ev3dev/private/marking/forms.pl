:- module(ev3dev_marking_forms,
          [ form/2,                     % ?Format, ?File
            write_form/4,               % +Format, +Exercise, +Class, +Marked
            has_form/3,                 % +Format, +Class, +Marked
            gradescope/2,               % +Mark, +Visibility
            end_words/2,                % +Ended, -Words
            text/1                      % +Text
          ]).
:- use_module('../basics/fields', [goal_expansion/2, term_expansion/2]).
:- use_module(records, []).
:- use_module(participants, [grade_number/2, worksheet/2]).
:- use_module(library(csv), [csv_write_stream/3]).
:- use_module(library(http/json), [json_write/2]).
:- use_module(library(lists), [append/3, member/2, nth1/3]).
:- use_module(library(sgml), [xml_quote_attribute/3]).

/** <module> Marks in the forms of other programs
*/

%!  form(?Format, ?File) is nondet.
%
%   The class is one File in these formats.

form(csv, 'marks.csv').
form(junit, 'junit.xml').
form(json, 'results.json').
form(moodle, 'moodle.csv').
form(classroom, 'classroom.csv').

%!  has_form(+Format, +Class, +Marked) is semidet.
%
%   True if there is something to write: Moodle and GitHub Classroom need to
%   know who the students are.

has_form(moodle, Class, Marked) :-
    !,
    Class = class(participants: Participants),
    (   worksheet(Participants, _)
    ->  true
    ;   member(marked(submission: submission(_, Keys, _, _)), Marked),
        memberchk(id(_), Keys)
    ->  true
    ).
has_form(classroom, Class, Marked) :-
    !,
    Class = class(participants: participants(Header, _)),
    (   memberchk(github_username, Header)
    ->  true
    ;   member(marked(submission: submission(_, Keys, _, _)), Marked),
        memberchk(user(_), Keys)
    ->  true
    ).
has_form(_, _, _).

%!  write_form(+Format, +Exercise, +Class, +Marked) is det.
%
%   Print it.

write_form(csv, Exercise, _, Marked) :-
    csv(Exercise, Marked).
write_form(junit, Exercise, _, Marked) :-
    junit(Exercise, Marked).
write_form(json, Exercise, Class, Marked) :-
    json_marks(Exercise, Class, Marked).
write_form(moodle, _, Class, Marked) :-
    Class = class(participants: Participants),
    moodle(Participants, Marked, Table),
    csv_table(Table).
write_form(classroom, Exercise, Class, Marked) :-
    Class = class(participants: Participants),
    classroom(Exercise, Participants, Marked, Table),
    csv_table(Table).

csv(exercise(_, _, _, Scores), Marked) :-
    findall(Text, member(score(_, Text, _, _), Scores), Texts),
    append([name, points, of|Texts], [remark], Head),
    findall(Cells,
            ( member(marked(name: Name,
                            mark: mark(_, P, Of, Its, _, Reason)),
                     Marked),
              findall(E, member(score(_, E, _, _), Its), Earned),
              append([Name, P, Of|Earned], [Reason], Cells) ),
            Rows),
    csv_table([Head|Rows]).

csv_table(Table) :-
    findall(Row, ( member(Cells, Table), csv_row(Cells, Row) ), Rows),
    current_output(Out),
    csv_write_stream(Out, Rows, []).

%   A text that a spreadsheet would take for a formula begins with '.

csv_row(Cells0, Row) :-
    findall(Cell, ( member(Cell0, Cells0), csv_cell(Cell0, Cell) ), Cells),
    Row =.. [row|Cells].

csv_cell(Cell0, Cell) :-
    (   atom(Cell0),
        Cell0 \== (-),
        sub_atom(Cell0, 0, 1, _, First),
        memberchk(First, [=, +, -, @, '\t', '\r'])
    ->  atom_concat('''', Cell0, Cell)
    ;   Cell = Cell0
    ).

junit(exercise(_, Title, _, _), Marked) :-
    format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>~n<testsuites>~n", []),
    forall(member(marked(name: Name,
                         mark: mark(scores: Scores, runs: Runs,
                                    reason: Reason)),
                  Marked),
           ( length(Scores, Tests),
             length(Runs, RunCount),
             findall(x, ( member(score(_, _, _, M), Scores), M > 0 ), Bad),
             length(Bad, Failures),
             format("<testsuite name=\"", []), text(Name),
             format("\" tests=\"~d\" failures=\"~d\">~n", [Tests, Failures]),
             forall(member(score(Text, P, F, Missed), Scores),
                    ( format("<testcase classname=\"", []), text(Title),
                      format("\" name=\"", []), text(Text),
                      (   Missed =:= 0
                      ->  format("\"/>~n", [])
                      ;   format("\"><failure message=\"~w of ~w points, \c
                                  not in ~d of ~d runs\">",
                                 [P, F, Missed, RunCount]),
                          text(Reason),
                          format("</failure></testcase>~n", [])
                      ) )),
             format("</testsuite>~n", []) )),
    format("</testsuites>~n", []).

json_marks(exercise(_, Title, _, _), Class, Marked) :-
    Class = class(left: Left),
    findall(json([ name=Name, points=P, of=Of, scores=ScoreObjects,
                   runs=RunObjects, remark=Reason ]),
            ( member(marked(Name, mark(_, P, Of, Scores, Runs, Reason), _, _,
                            _),
                     Marked),
              findall(json([score=S, points=E, of=F, missed=M]),
                      member(score(S, E, F, M), Scores), ScoreObjects),
              findall(json([seed=Seed, points=E, end=End, seconds=Time]),
                      ( member(run(Seed, E, Ended, Time), Runs),
                        end_words(Ended, End) ),
                      RunObjects) ),
            Objects),
    findall(json([file=File, reason=Why]), member(left(File, Why), Left),
            Others),
    json(json([exercise=Title, marks=Objects, not_marked=Others])).

%!  gradescope(+Mark, +Visibility) is det.
%
%   The results.json of Gradescope's autograder. `after_published` hides all
%   until the teacher publishes the grades; what the autograder itself prints,
%   `stdout`, stays hidden. (gradescope-autograders.readthedocs.io, Autograder
%   Specifications, Output format and Controlling Test Case Visibility.)

gradescope(mark(_, Points, _, Scores, Runs, Reason), Visibility) :-
    length(Runs, Count),
    findall(json([name=Text, score=E, max_score=F, output=Words]),
            ( member(score(Text, E, F, Missed), Scores),
              missed(Missed, Count, Words) ),
            Tests),
    json(json([ score=Points, output=Reason, output_format=text,
                visibility=Visibility, stdout_visibility=hidden,
                tests=Tests ])).

missed(0, _, '') :-
    !.
missed(Missed, Count, Words) :-
    format(atom(Words), 'not in ~d of ~d runs', [Missed, Count]).

json(Term) :-
    current_output(Out),
    json_write(Out, Term),
    nl.

%   Moodle's offline grading worksheet: it is filled in if it is given, else
%   made with the columns that the import needs. Comments are HTML.
%   (importgradeslib.php and locallib.php in mod/assign/feedback/offline, and
%   mod/assign/feedback/comments/locallib.php, of Moodle 4.)

moodle(Participants, Marked, [Header|Table]) :-
    worksheet(Participants, columns(Grade, Most, Feedback)),
    !,
    Participants = participants(Header, Rows),
    findall(Cells,
            ( nth1(N, Rows, Row),
              (   marked_row(N, Marked, Mark)
              ->  Mark = mark(points: Points, of: Of),
                  nth1(Most, Row, Most0),
                  moodle_grade(Points, Of, Most0, Earned),
                  moodle_feedback(Mark, Text),
                  findall(Cell,
                          ( nth1(I, Row, Cell0),
                            (   I =:= Grade
                            ->  Cell = Earned
                            ;   I =:= Feedback
                            ->  Cell = Text
                            ;   Cell = Cell0
                            ) ),
                          Cells)
              ;   Cells = Row
              ) ),
            Table).
moodle(_, Marked,
       [ [ 'Identifier', 'Full name', 'Grade', 'Last modified (grade)',
           'Feedback comments' ]
       | Table ]) :-
    findall([Identifier, Name, Points, '', Text],
            ( member(marked(name: Name, mark: Mark,
                            submission: submission(_, Keys, _, _)),
                     Marked),
              memberchk(id(Id), Keys),
              atom_concat('Participant ', Id, Identifier),
              Mark = mark(points: Points),
              moodle_feedback(Mark, Text) ),
            Table).

marked_row(N, Marked, Mark) :-
    member(marked(mark: Mark, submission: submission(_, Keys, _, _)), Marked),
    memberchk(row(N), Keys),
    !.

%   The maximum there may be another one, as 100.

moodle_grade(Points, Of, Most0, Grade) :-
    (   grade_number(Most0, Most),
        Most =\= Of,
        Of > 0
    ->  Hundredths is round(100*Points*Most/Of),
        (   Hundredths mod 100 =:= 0
        ->  Grade is Hundredths//100
        ;   Grade is Hundredths/100.0
        )
    ;   Grade = Points
    ).

moodle_feedback(mark(_, _, _, Scores, Runs, Reason), Html) :-
    length(Runs, Count),
    with_output_to(atom(Html),
        ( forall(member(score(Text, P, Of, Missed), Scores),
                 ( format("~w of ~w: ", [P, Of]),
                   text(Text),
                   (   missed(Missed, Count, Words),
                       Words \== ''
                   ->  format(" (~w)", [Words])
                   ;   true
                   ),
                   format("<br>", []) )),
          text(Reason) )).

%   The columns of `gh classroom assignment-grades` that are known here, for
%   students who have a user name. (gradeCSVHeaders in
%   cmd/gh-classroom/assignment-grades of github.com/github/gh-classroom; the
%   roster has identifier, github_username, github_id, name.)

classroom(exercise(_, Title, _, _), participants(Header, Rows), Marked,
          [ [ assignment_name, github_username, roster_identifier,
              student_repository_name, points_awarded, points_available ]
          | Table ]) :-
    findall([Title, User, Identifier, Name, Points, Of],
            ( member(marked(name: Name,
                            mark: mark(points: Points, of: Of),
                            submission: submission(_, Keys, _, _)),
                     Marked),
              (   memberchk(row(N), Keys)
              ->  nth1(N, Rows, Row)
              ;   Row = []
              ),
              (   roster(github_username, Header, Row, User)
              ->  true
              ;   memberchk(user(User), Keys)
              ),
              ( roster(identifier, Header, Row, Identifier) -> true
              ; Identifier = '' ) ),
            Table).

roster(Column, Header, Row, Value) :-
    nth1(N, Header, Column),
    nth1(N, Row, Value),
    !.

%!  end_words(+Ended, -Words) is det.

end_words(over, 'time over').
end_words(not_run, 'not run').
end_words(exit(0), 'ended by itself').
end_words(exit(Status), Words) :-
    Status \== 0,
    format(atom(Words), 'ended with the status ~w', [Status]).
end_words(killed(Signal), Words) :-
    format(atom(Words), 'crashed (signal ~w)', [Signal]).
end_words(limit(cpu), 'too much processor time').
end_words(limit(sleep), 'slept too long').
end_words(limit(memory), 'too much memory').
end_words(limit(processes), 'too many processes').
end_words(limit(output), 'printed too much').
end_words(refused(_), 'refused').
end_words(lost, 'not judged').
end_words(error(_), 'lost').

%!  text(+Text) is det.
%
%   Print Text in HTML or XML, without what XML cannot have.

text(Text) :-
    format(string(String), "~w", [Text]),
    string_codes(String, Codes0),
    findall(Code,
            ( member(Code0, Codes0),
              ( Code0 < 32, Code0 =\= 10 -> Code = 32 ; Code = Code0 ) ),
            Codes),
    atom_codes(Clean, Codes),
    xml_quote_attribute(Clean, Quoted, utf8),
    write(Quoted).
