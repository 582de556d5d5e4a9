:- module(ev3dev_marking_report,
          [ write_reports/5,            % +Formats, +Directory, +Exercise,
                                        % +Class, +Marked
            write_page/4                % +File, +Exercise, +Shown, +Marked
          ]).
:- use_module('../basics/fields', [goal_expansion/2, term_expansion/2]).
:- use_module(records, []).
:- use_module(alike, [alike/4, alike_lines/3]).
:- use_module(film, [film/3]).
:- use_module(forms,
              [ end_words/2, form/2, gradescope/2, has_form/3, text/1,
                write_form/4 ]).
:- use_module(kept, [writing/2]).
:- use_module(read, [exercise_seeds/3]).
:- use_module(submissions, [can_be/2]).
:- use_module(library(filesex),
              [directory_file_path/3, make_directory_path/1]).
:- use_module(library(lists),
              [append/3, member/2, nth0/3, nth1/3, sum_list/2]).
:- use_module(library(uri), [uri_encoded/3]).

/** <module> Marks in files: for the teacher, the student, and other programs

Pages are whole: no style, picture or script is elsewhere. All texts of
programs are escaped.
*/

%!  write_reports(+Formats, +Directory, +Exercise, +Class, +Marked) is det.
%
%   Formats is a list, or `all`, which leaves out those for which nothing is
%   known.

write_reports(Formats, Directory, Exercise, Class, Marked) :-
    make_directory_path(Directory),
    findall(Name, member(marked(name: Name), Marked), Names),
    page_names(Names, [], Pages),
    forall(( member(Format, [html, gradescope])
           ; form(Format, _) ),
           (   (   Formats == all
               ->  has_form(Format, Class, Marked)
               ;   memberchk(Format, Formats)
               )
           ->  write_report(Format, Directory, Exercise, Class, Pages, Marked)
           ;   true
           )).

write_report(html, Directory, Exercise, Class, Pages, Marked) :-
    !,
    exercise_seeds(Exercise, open, Open),
    forall(member(One, Marked),
           ( One = marked(name: Name),
             page_file(Directory, pages, Name, Pages, '.html', File),
             write_page(File, Exercise, Open, One) )),
    directory_file_path(Directory, 'index.html', Index),
    to_file(Index, class_page(Exercise, Class, Pages, Marked)).
write_report(gradescope, Directory, Exercise, _, Pages, Marked) :-
    !,
    exercise_seeds(Exercise, all, Seeds),
    forall(member(marked(name: Name, mark: Mark), Marked),
           ( page_file(Directory, gradescope, Name, Pages, '.json', File),
             Mark = mark(runs: Runs),
             (   member(run(Seed, _, _, _), Runs),
                 \+ memberchk(Seed, Seeds)
             ->  Visibility = after_published
             ;   Visibility = visible
             ),
             to_file(File, gradescope(Mark, Visibility)) )).
write_report(Format, Directory, Exercise, Class, _, Marked) :-
    form(Format, Name),
    directory_file_path(Directory, Name, File),
    to_file(File, write_form(Format, Exercise, Class, Marked)).

page_file(Directory, Folder, Name, Pages, Ending, File) :-
    directory_file_path(Directory, Folder, Path),
    make_directory_path(Path),
    memberchk(Name-Page, Pages),
    atom_concat(Page, Ending, Base),
    directory_file_path(Path, Base, File).

%   A name may have anything in it, and 255 bytes. That of its page is short
%   and plain, and differs from the others by more than capitals.

page_names([], _, []).
page_names([Name|Names], Taken, [Name-Page|Pages]) :-
    can_be(Name, Name1),
    atom_codes(Name1, Codes0),
    findall(Code,
            ( nth0(N, Codes0, Code0),
              N < 60,
              (   code_type(Code0, alnum)
              ->  Code = Code0
              ;   memberchk(Code0, [0' , 0'-, 0'.]),
                  N > 0
              ->  Code = Code0
              ;   Code = 0'_
              ) ),
            Codes),
    atom_codes(Plain, Codes),
    free_page(Plain, 1, Taken, Page, Low),
    page_names(Names, [Low|Taken], Pages).

free_page(Plain, Number, Taken, Page, Low) :-
    (   Number =:= 1
    ->  Page1 = Plain
    ;   atomic_list_concat([Plain, Number], '_', Page1)
    ),
    downcase_atom(Page1, Low1),
    (   memberchk(Low1, Taken)
    ->  Next is Number+1,
        free_page(Plain, Next, Taken, Page, Low)
    ;   Page = Page1,
        Low = Low1
    ).

:- meta_predicate to_file(+, 0).

to_file(File, Goal) :-
    with_output_to(string(Text), Goal),
    writing(File, setup_call_cleanup(
                      open(File, write, Out, [encoding(utf8)]),
                      ( write(Out, Text), flush_output(Out) ),
                      close(Out, [force(true)]))).

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
            main { max-width: 60rem; margin: auto; padding: 0 1rem; \c
            overflow-wrap: anywhere }~n\c
            table { border-collapse: collapse; margin: 1rem 0; \c
            overflow-wrap: break-word }~n\c
            th, td { padding: .3rem .6rem; text-align: left; \c
            border-bottom: 1px solid #8886; vertical-align: top }~n\c
            td.n, th.n { text-align: right }~n\c
            td:first-child, td:last-child { overflow-wrap: anywhere }~n\c
            .sort th:first-child { min-width: 8rem }~n\c
            th.r { min-width: 14rem }~n\c
            .two { display: flex; gap: 1rem }~n\c
            .two pre { flex: 1; min-width: 0; overflow-x: auto }~n\c
            .bar { background: #36c; height: .7rem; min-width: 1px }~n\c
            .wide { overflow-x: auto }~n\c
            svg { max-width: 100%; height: auto; background: #fff }~n\c
            .histogram { width: 30rem; background: none; fill: #36c }~n\c
            .histogram text { font-size: 9px; fill: currentColor }~n\c
            .histogram { text-anchor: middle }~n\c
            .sort th { cursor: pointer; \c
            text-decoration: underline dotted }~n\c
            mark { background: #fd68; color: inherit }~n\c
            input[type=range] { width: 100% }~n\c
            @media print { button, input { display: none }~n\c
            .bar, .histogram { print-color-adjust: exact }~n\c
            tr { break-inside: avoid } .wide { overflow: visible } }~n", []).

%!  write_page(+File, +Exercise, +Shown, +Marked) is det.
%
%   The page of one program, with its worst run. Shown is a list of the seeds
%   that the student may see, or `all`.

write_page(File, Exercise, Shown, Marked) :-
    Exercise = exercise(_, Title0, _, _),
    Marked = marked(name: Name),
    format(atom(Title), '~w: ~w', [Title0, Name]),
    to_file(File, page(Title, one_page(Exercise, Shown, Marked))).

one_page(Exercise, Shown, marked(_, Mark, Results, _, _)) :-
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
            <th class=\"r\">Remark~n", []),
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

%   That with the least points, of those that drove.

worst(Runs, Results, Seed, Result) :-
    findall(Points-N,
            ( nth1(N, Runs, run(_, Points, _, _)),
              nth1(N, Results, result(_, result(film: [_, _|_])))
            ),
            Pairs),
    msort(Pairs, [_-First|_]),
    nth1(First, Results, result(Seed, Result)).

class_page(Exercise, Class, Pages, Marked) :-
    Exercise = exercise(_, Title, _, Scores),
    page(Title, class_body(Scores, Class, Pages, Marked)).

class_body(Scores, Class, Pages, Marked) :-
    findall(P, member(marked(mark: mark(points: P)), Marked), Ps),
    length(Ps, Count),
    sum_list(Ps, Sum),
    Mean is Sum/max(1, Count),
    format("<p>~d programs, ~2f points in the mean", [Count, Mean]),
    ( median(Ps, Median) -> format(", ~w in the middle", [Median]) ; true ),
    format(".</p>~n", []),
    histogram(Marked),
    format("<div class=\"wide\"><table class=\"sort\">~n<tr><th>Program\c
            <th class=\"n\">Points<th class=\"n\">of<th>Share\c
            <th>Worst run<th class=\"r\">Remark~n", []),
    forall(member(One, Marked), class_row(One, Pages)),
    format("</table></div>~n", []),
    missed_scores(Scores, Count, Marked),
    Class = class(left: Left),
    not_marked(Left),
    similar(Class, Marked),
    sorting.

class_row(marked(Name, mark(_, P, Of, _, Runs, Reason), Results, _, _),
          Pages) :-
    memberchk(Name-Page, Pages),
    uri_encoded(path, Page, Link),
    Percent is round(100*P/Of),
    format("<tr><td><a href=\"pages/~w.html\">", [Link]),
    text(Name),
    format("</a><td class=\"n\">~w<td class=\"n\">~w<td>\c
            <div class=\"bar\" style=\"width: ~2fem\"></div><td>",
           [P, Of, Percent/12.5]),
    (   worst(Runs, Results, Seed, _)
    ->  format("<a href=\"pages/~w.html#worst\">seed ~w</a>", [Link, Seed])
    ;   true
    ),
    format("<td>", []),
    text(Reason),
    nl.

median(Ps, Median) :-
    msort(Ps, Sorted),
    length(Sorted, Count),
    Count > 0,
    Upper is Count//2,
    Lower is (Count-1)//2,
    nth0(Upper, Sorted, A),
    nth0(Lower, Sorted, B),
    Mean is (A+B)/2.0,
    ( Mean =:= truncate(Mean) -> Median is truncate(Mean)
    ; Median is round(100*Mean)/100.0 ).

%   How many have how much of the points, in ten parts.

histogram(Marked) :-
    findall(Part,
            ( member(marked(mark: mark(points: P, of: Of)), Marked),
              Of > 0,
              Part is min(9, floor(10*P/Of)) ),
            Parts),
    findall(Count,
            ( between(0, 9, Part),
              findall(x, member(Part, Parts), Its),
              length(Its, Count) ),
            Counts),
    msort([1|Counts], Sorted),
    append(_, [Most], Sorted),
    format("<svg class=\"histogram\" viewBox=\"0 0 320 100\" role=\"img\" \c
            aria-label=\"How many programs have how much of the points\">~n",
           []),
    forall(nth0(N, Counts, Count),
           ( X is 30*N,
             Height is 70*Count/Most,
             Top is 80-Height,
             Middle is X+15,
             Label is Top-3,
             format("<rect x=\"~d\" y=\"~1f\" width=\"28\" \c
                     height=\"~1f\"/>~n", [X, Top, Height]),
             ( Count > 0
             ->  format("<text x=\"~d\" y=\"~1f\">~d</text>~n",
                        [Middle, Label, Count])
             ;   true ),
             format("<text x=\"~d\" y=\"93\">~d0</text>~n", [X, N]) )),
    format("<text x=\"303\" y=\"93\">100 %</text>~n</svg>~n", []).

missed_scores(Scores, Count, Marked) :-
    findall(Share-score(Text, Full, Mean, Missed),
            ( nth1(N, Scores, score(Full, Text, _, _)),
              findall(P-M,
                      ( member(marked(mark: mark(scores: Its)), Marked),
                        nth1(N, Its, score(_, P, _, M)) ),
                      Earned),
              findall(P, member(P-_, Earned), Ps),
              sum_list(Ps, Sum),
              Mean is Sum/max(1, Count),
              Share is Mean/Full,
              findall(x, ( member(_-M, Earned), M > 0 ), Misses),
              length(Misses, Missed) ),
            Rows),
    format("<h2>What was missed</h2>~n", []),
    (   keysort(Rows, [Least-score(Hardest, _, _, _)|_]),
        Least < 1
    ->  Percent is round(100*Least),
        format("<p>Hardest: ", []),
        text(Hardest),
        format(", with ~d % of its points in the mean.</p>~n", [Percent])
    ;   true
    ),
    format("<div class=\"wide\"><table class=\"sort\">~n<tr><th>Score\c
            <th class=\"n\">of<th class=\"n\">in the mean\c
            <th class=\"n\">programs that missed it in some run~n", []),
    forall(member(_-score(Text, Full, Mean, Missed), Rows),
           ( format("<tr><td>", []),
             text(Text),
             format("<td class=\"n\">~w<td class=\"n\">~2f\c
                     <td class=\"n\">~d~n", [Full, Mean, Missed]) )),
    format("</table></div>~n", []).

not_marked([]) :-
    !.
not_marked(Left) :-
    format("<h2>Not marked</h2>~n<ul>~n", []),
    forall(member(left(File, Why), Left),
           ( format("<li>", []), text(File), format(": ", []), text(Why),
             nl )),
    format("</ul>~n", []).

%   A click on a heading sorts; another one turns the order around.

sorting :-
    format("<script>~n\c
for (const table of document.querySelectorAll('table.sort')) {~n\c
  const [head, ...rows] = table.rows~n\c
  const value = (row, n) => row.cells[n].textContent.trim() ||~n\c
    row.cells[n].querySelector('div')?.style.width || ''~n\c
  ;[...head.cells].forEach((cell, n) => {~n\c
    let turn = 1~n\c
    cell.tabIndex = 0~n\c
    cell.title = 'sort'~n\c
    const sort = () => {~n\c
      rows.sort((a, b) => turn * value(a, n).localeCompare(~n\c
        value(b, n), undefined, { numeric: true }))~n\c
      turn = -turn~n\c
      for (const row of rows) row.parentNode.append(row)~n\c
    }~n\c
    cell.addEventListener('click', sort)~n\c
    cell.addEventListener('keydown', event => {~n\c
      if (event.key === 'Enter') sort()~n\c
    })~n\c
  })~n\c
}~n\c
</script>~n", []).

% ---------------- LIKENESS

most_pairs(100).

similar(Class, Marked) :-
    Class = class(earlier: Earlier, given: Given),
    findall(Name-Terms,
            ( member(marked(name: Name, submission: Submission), Marked),
              whole_text(Submission, _, Terms) ),
            Programs),
    findall(Name-Terms,
            ( member(Submission, Earlier),
              Submission = submission(Name, _, _, _),
              whole_text(Submission, _, Terms) ),
            Others),
    alike(Programs, Others, Given, Pairs),
    (   Pairs == []
    ->  true
    ;   length(Pairs, Count),
        most_pairs(Most),
        Shown is min(Count, Most),
        format("<h2>Programs that look alike</h2>~n<p>Their structure is \c
                the same, whatever the names and the order of clauses. That \c
                is a reason to ask, and no judgement. ", []),
        ( Shown < Count
        ->  format("Shown are ~d of ~d pairs.", [Shown, Count])
        ;   true ),
        format("</p>~n", []),
        forall(( nth1(N, Pairs, Pair), N =< Shown ),
               side_by_side(Pair, Earlier, Marked))
    ).

side_by_side(alike(A, B, Share, Shared), Earlier, Marked) :-
    Percent is round(100*Share),
    format("<details><summary>", []),
    text(A),
    format(" and ", []),
    ( B = this(Name) -> true ; B = earlier(Name), format("earlier: ", []) ),
    text(Name),
    format(": ~d %</summary>~n<div class=\"two\">~n", [Percent]),
    forall(( member(Which, [this(A), B]),
             program_of(Which, Earlier, Marked, Submission) ),
           ( whole_text(Submission, Text, Terms),
             alike_lines(Terms, Shared, Starts),
             findall(Line, member(term(_, Line), Terms), Lines),
             split_string(Text, "\n", "\r", Texts),
             format("<pre>", []),
             marked_lines(Texts, 1, plain, Lines, Starts),
             format("</pre>~n", []) )),
    format("</div></details>~n", []).

program_of(this(Name), _, Marked, Submission) :-
    member(marked(name: Name, submission: Submission), Marked),
    !.
program_of(earlier(Name), Earlier, _, Submission) :-
    Submission = submission(Name, _, _, _),
    memberchk(Submission, Earlier).

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
           ( alike_lines(Terms, Clauses, Starts),
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
