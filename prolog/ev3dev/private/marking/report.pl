:- module(ev3dev_marking_report,
          [ write_reports/4,            % +Formats, +Directory, +Exercise,
                                        % +Marked
            write_page/4                % +File, +Exercise, +Shown, +Marked
          ]).
:- use_module('../basics/fields', [goal_expansion/2, term_expansion/2]).
:- use_module(records, []).
:- use_module(alike, [alike/2, clause_lines/3]).
:- use_module(film, [film/3]).
:- use_module(read, [exercise_seeds/3]).
:- use_module(library(filesex),
              [directory_file_path/3, make_directory_path/1]).
:- use_module(library(csv), [csv_write_stream/3]).
:- use_module(library(http/json), [json_write/2]).
:- use_module(library(lists),
              [append/3, member/2, nth1/3, sum_list/2]).
:- use_module(library(sgml), [xml_quote_attribute/3]).
:- use_module(library(uri), [uri_encoded/3]).

/** <module> Marks in files: for the teacher, the student, and other programs

Pages are whole: no style, picture or script is elsewhere. All texts of
programs are escaped.
*/

%!  write_reports(+Formats, +Directory, +Exercise, +Marked) is det.

write_reports(Formats, Directory, Exercise, Marked) :-
    make_directory_path(Directory),
    forall(member(Format, Formats),
           write_report(Format, Directory, Exercise, Marked)).

write_report(html, Directory, Exercise, Marked) :-
    directory_file_path(Directory, pages, Pages),
    make_directory_path(Pages),
    forall(member(One, Marked),
           ( One = marked(name: Name),
             html_file(Pages, Name, File),
             exercise_seeds(Exercise, open, Open),
             write_page(File, Exercise, Open, One) )),
    directory_file_path(Directory, 'index.html', Index),
    to_file(Index, class_page(Exercise, Marked)).
write_report(gradescope, Directory, _, Marked) :-
    directory_file_path(Directory, gradescope, Folder),
    make_directory_path(Folder),
    forall(member(marked(Name, Mark, _, _), Marked),
           ( atom_concat(Name, '.json', Base),
             directory_file_path(Folder, Base, File),
             to_file(File, gradescope(Mark)) )).

write_report(Format, Directory, Exercise, Marked) :-
    one_file(Format, Name, Writer),
    directory_file_path(Directory, Name, File),
    to_file(File, call(Writer, Exercise, Marked)).

one_file(csv, 'marks.csv', csv).
one_file(junit, 'junit.xml', junit).
one_file(json, 'results.json', json_marks).

html_file(Folder, Name, File) :-
    atom_concat(Name, '.html', Base),
    directory_file_path(Folder, Base, File).

:- meta_predicate to_file(+, 0).

to_file(File, Goal) :-
    setup_call_cleanup(
        open(File, write, Out, [encoding(utf8)]),
        ( with_output_to(string(Text), Goal), write(Out, Text) ),
        close(Out)).

% ---------------- HTML

page(Title, Body) :-
    format("<!DOCTYPE html>~n<html lang=\"en\">~n<meta charset=\"utf-8\">~n\c
            <meta name=\"viewport\" content=\"width=device-width\">~n", []),
    format("<title>", []), text(Title), format("</title>~n<style>~n", []),
    style,
    format("</style>~n<main>~n<h1>", []), text(Title), format("</h1>~n", []),
    call(Body),
    format("</main>~n</html>~n", []).

:- meta_predicate page(+, 0).

style :-
    format(":root { color-scheme: light dark; font-family: sans-serif }~n\c
            main { max-width: 60rem; margin: auto; padding: 0 1rem }~n\c
            table { border-collapse: collapse; margin: 1rem 0 }~n\c
            th, td { padding: .3rem .6rem; text-align: left; \c
            border-bottom: 1px solid #8886; vertical-align: top }~n\c
            td.n, th.n { text-align: right }~n\c
            .two { display: flex; gap: 1rem }~n\c
            .two pre { flex: 1; overflow-x: auto }~n\c
            .bar { background: #36c; height: .7rem; min-width: 1px }~n\c
            .wide { overflow-x: auto }~n\c
            svg { max-width: 100%; height: auto; background: #fff }~n\c
            input[type=range] { width: 100% }~n", []).

%!  write_page(+File, +Exercise, +Shown, +Marked) is det.
%
%   The page of one program, with its worst run. Shown is a list of the seeds
%   that the student may see, or `all`.

write_page(File, Exercise, Shown, Marked) :-
    Exercise = exercise(_, Title0, _, _),
    Marked = marked(name: Name),
    format(atom(Title), '~w: ~w', [Title0, Name]),
    to_file(File, page(Title, one_page(Exercise, Shown, Marked))).

one_page(Exercise, Shown, marked(_, Mark, Results, _)) :-
    Mark = mark(_, Points, Of, Scores, Runs, Reason),
    format("<p><strong>~w of ~w points</strong></p>~n", [Points, Of]),
    (   Reason == ''
    ->  true
    ;   paragraph(Reason)
    ),
    format("<div class=\"wide\"><table>~n<tr><th class=\"n\">Points\c
            <th class=\"n\">of<th>for<th>missed in~n", []),
    length(Runs, Count),
    forall(member(score(Text, P, F, Missed), Scores),
           ( format("<tr><td class=\"n\">~w<td class=\"n\">~w<td>", [P, F]),
             text(Text),
             (   Missed =:= 0
             ->  format("<td>~n", [])
             ;   format("<td>~d of ~d runs~n", [Missed, Count])
             ) )),
    format("</table></div>~n<h2>Runs</h2>~n<div class=\"wide\"><table>~n\c
            <tr><th class=\"n\">Run<th class=\"n\">Seed\c
            <th class=\"n\">Points<th class=\"n\">Seconds<th>End\c
            <th>Remark~n", []),
    forall(( nth1(N, Runs, run(Seed, P, Ended, Seconds)),
             nth1(N, Results, result(_, Result)) ),
           ( ( shown(Seed, Shown) -> Says = Seed ; Says = secret ),
             format("<tr><td class=\"n\">~w<td class=\"n\">~w\c
                     <td class=\"n\">~w<td class=\"n\">~w<td>",
                    [N, Says, P, Seconds]),
             end_words(Ended, Words),
             text(Words),
             format("<td>", []),
             (   Result = result(reason: Why, collision: Collision)
             ->  findall(T, ( member(T, [Why, Collision]), T \== '' ), Ts),
                 atomic_list_concat(Ts, ' ', Text),
                 text(Text)
             ;   true
             ),
             nl )),
    format("</table></div>~n", []),
    (   worst(Runs, Results, Seed, Result)
    ->  once(nth1(Which, Results, result(Seed, Result))),
        format("<h2 id=\"worst\">The worst run: run ~d</h2>~n", [Which]),
        film(Exercise, Seed, Result)
    ;   true
    ).

shown(_, all) :-
    !.
shown(Seed, Shown) :-
    memberchk(Seed, Shown).

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
end_words(limit(output), 'printed too much').
end_words(refused(_), 'refused').
end_words(lost, 'not judged').
end_words(error(_), 'lost').

%   That with the least points, of those that drove.

worst(Runs, Results, Seed, Result) :-
    findall(Points-N,
            ( nth1(N, Runs, run(_, Points, _, _)),
              nth1(N, Results, result(_, result(film: [_, _|_])))
            ),
            Pairs),
    msort(Pairs, [_-First|_]),
    nth1(First, Results, result(Seed, Result)).

class_page(exercise(_, Title, _, Scores), Marked) :-
    page(Title, class_body(Scores, Marked)).

class_body(Scores, Marked) :-
    findall(P, member(marked(mark: mark(points: P)), Marked), Ps),
    length(Ps, Count),
    sum_list(Ps, Sum),
    Mean is Sum/max(1, Count),
    format("<p>~d programs, ~2f points in the mean.</p>~n\c
            <div class=\"wide\"><table>~n<tr><th>Program\c
            <th class=\"n\">Points<th class=\"n\">of<th>Share<th>Remark~n",
           [Count, Mean]),
    forall(member(marked(name: Name,
                         mark: mark(points: P, of: Of, reason: Reason)),
                  Marked),
           ( Percent is round(100*P/Of),
             format("<tr><td><a href=\"pages/", []),
             uri_encoded(path, Name, Link),
             format("~w.html\">", [Link]),
             text(Name),
             format("</a><td class=\"n\">~w<td class=\"n\">~w<td>\c
                     <div class=\"bar\" style=\"width: ~2fem\"></div><td>",
                    [P, Of, Percent/12.5]),
             text(Reason),
             nl )),
    format("</table></div>~n<h2>What was missed</h2>~n\c
            <div class=\"wide\"><table>~n<tr><th>Score<th class=\"n\">of\c
            <th class=\"n\">in the mean<th class=\"n\">programs that missed \c
            it in some run~n", []),
    forall(nth1(N, Scores, score(Full, Text, _, _)),
           ( findall(P-Missed,
                     ( member(marked(mark: mark(scores: Its)),
                              Marked),
                       nth1(N, Its, score(_, P, _, Missed)) ),
                     Earned),
             findall(P, member(P-_, Earned), EarnedPs),
             sum_list(EarnedPs, EarnedSum),
             EarnedMean is EarnedSum/max(1, Count),
             findall(x, ( member(_-Missed, Earned), Missed > 0 ), Misses),
             length(Misses, MissCount),
             format("<tr><td>", []),
             text(Text),
             format("<td class=\"n\">~w<td class=\"n\">~2f\c
                     <td class=\"n\">~d~n", [Full, EarnedMean, MissCount])
           )),
    format("</table></div>~n", []),
    findall(Name-Terms,
            ( member(marked(name: Name, submission: Submission), Marked),
              whole_text(Submission, _, Terms) ),
            Programs),
    alike(Programs, Pairs),
    (   Pairs == []
    ->  true
    ;   format("<h2>Programs that look alike</h2>~n<p>Their clauses are \c
                the same but for the names of variables. That is a reason \c
                to ask, and no judgement.</p>~n", []),
        forall(member(Pair, Pairs), side_by_side(Pair, Marked))
    ).

%   All files as one text.

whole_text(submission(_, _, Files, _), Text, Terms) :-
    ( Files = [_] -> Heads = false ; Heads = true ),
    whole_text(Files, Heads, 0, Texts, Terms),
    atomic_list_concat(Texts, Atom),
    atom_string(Atom, Text).

whole_text([], _, _, [], []).
whole_text([file(Path, _, Text, Its)|Files], Heads, Above, [Part|Texts],
           Terms) :-
    (   Heads == true
    ->  format(string(Part), "% ~w~n~w~n", [Path, Text]),
        Above1 is Above+1
    ;   Part = Text,
        Above1 = Above
    ),
    split_string(Part, "\n", "", Lines),
    length(Lines, Count),
    Below is Above+Count-1,
    findall(term(Term, Line),
            ( member(term(Term, Line0), Its), Line is Line0+Above1 ),
            Here),
    append(Here, Others, Terms),
    whole_text(Files, Heads, Below, Texts, Others).

%   What both have is marked.

side_by_side(alike(A, B, Share, Clauses), Marked) :-
    Percent is round(100*Share),
    format("<details><summary>", []), text(A), format(" and ", []), text(B),
    format(": ~d %</summary>~n<div class=\"two\">~n", [Percent]),
    forall(( member(Name, [A, B]),
             member(marked(name: Name, submission: Submission), Marked),
             whole_text(Submission, Text, Terms) ),
           ( clause_lines(Terms, Clauses, Starts),
             findall(Line, member(term(_, Line), Terms), Lines),
             split_string(Text, "\n", "\r", Texts),
             format("<pre>", []),
             marked_lines(Texts, 1, plain, Lines, Starts),
             format("</pre>~n", []) )),
    format("</div></details>~n", []).

%   A clause ends where the next term begins, or at an empty line.

marked_lines([], _Number, _Kind, _Lines, _Starts).
marked_lines([Text|Texts], Number, Kind0, Lines, Starts) :-
    (   memberchk(Number, Starts)
    ->  Kind = mark
    ;   ( Text == "" ; memberchk(Number, Lines) )
    ->  Kind = plain
    ;   Kind = Kind0
    ),
    (   Kind == mark
    ->  format("<mark>", []), text(Text), format("</mark>~n", [])
    ;   text(Text), nl
    ),
    Next is Number+1,
    marked_lines(Texts, Next, Kind, Lines, Starts).

paragraph(Text) :-
    format("<p>", []),
    text(Text),
    format("</p>~n", []).

%   Text in HTML and XML, without what XML cannot have.

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

% ---------------- OTHER FORMS

csv(exercise(_, _, _, Scores), Marked) :-
    findall(Text, member(score(_, Text, _, _), Scores), Texts),
    append([name, points, of|Texts], [remark], Head),
    findall(Row,
            (   csv_row(Head, Row)
            ;   member(marked(Name, mark(_, P, Of, Its, _, Reason), _, _),
                       Marked),
                findall(E, member(score(_, E, _, _), Its), Earned),
                append([Name, P, Of|Earned], [Reason], Cells),
                csv_row(Cells, Row)
            ),
            Rows),
    current_output(Out),
    csv_write_stream(Out, Rows, []).

%   A text that a spreadsheet would take for a formula begins with '.

csv_row(Cells0, Row) :-
    findall(Cell, ( member(Cell0, Cells0), csv_cell(Cell0, Cell) ), Cells),
    Row =.. [row|Cells].

csv_cell(Cell0, Cell) :-
    (   atom(Cell0),
        sub_atom(Cell0, 0, 1, _, First),
        memberchk(First, [=, +, -, @])
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

json_marks(exercise(_, Title, _, _), Marked) :-
    findall(json([ name=Name, points=P, of=Of, scores=ScoreObjects,
                   runs=RunObjects, remark=Reason ]),
            ( member(marked(Name, mark(_, P, Of, Scores, Runs, Reason), _, _),
                     Marked),
              findall(json([score=S, points=E, of=F, missed=M]),
                      member(score(S, E, F, M), Scores), ScoreObjects),
              findall(json([seed=Seed, points=E, end=End, seconds=Time]),
                      ( member(run(Seed, E, Ended, Time), Runs),
                        end_words(Ended, End) ),
                      RunObjects) ),
            Objects),
    json(json([exercise=Title, marks=Objects])).

%   The form that Gradescope's autograder reads: results.json of a submission.

gradescope(mark(_, Points, _, Scores, Runs, Reason)) :-
    length(Runs, Count),
    findall(json([name=Text, score=E, max_score=F, output=Words]),
            ( member(score(Text, E, F, Missed), Scores),
              (   Missed =:= 0
              ->  Words = ''
              ;   format(atom(Words), 'not in ~d of ~d runs', [Missed, Count])
              ) ),
            Tests),
    json(json([score=Points, output=Reason, tests=Tests])).

json(Term) :-
    current_output(Out),
    json_write(Out, Term),
    nl.
