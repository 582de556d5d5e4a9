:- module(ev3dev_marking_records, []).
:- use_module('../basics/fields', [fields/1]).

:- fields(result(ended, seconds, shares, reason, collision, film,
                 collisions)).
:- fields(mark(name, points, of, scores, runs, reason)).
:- fields(marked(name, mark, results, submission)).

/** <module> Records of marking

A result is that of a run, see run.pl; a mark is that of exercise_mark/4;
`marked` is a program with its mark, its results, and its submission.
*/
