:- module(ev3dev_marking_records, []).
:- use_module('../basics/fields', [fields/1]).

:- fields(result(ended, seconds, shares, reason, collision, film,
                 ways, collisions)).
:- fields(mark(name, points, of, scores, runs, reason)).
:- fields(marked(name, mark, results, submission, why)).
:- fields(class(participants, left, earlier, given)).

:- fields(batch(exercise, read, programs, enclosed, kept, options)).

/** <module> Records of marking

A result is that of a run, see run.pl; a mark is that of exercise_mark/4;
`marked` is a program with its mark, its results, its submission, and the
lines of its reason. A class has its list of participants; what is left, as of
submissions/4; submissions of an earlier class; and terms that are given, of
the skeleton.
*/
