/*  A robot of the installed pack drives among things, which come to rest where they do on a PC.

        swipl -g main -t 'halt(1)' tests/brick/things.pl

    EV3DEV_PACK names the pack's folder, as for smoke.pl.
*/

:- (   getenv('EV3DEV_PACK', Pack)
   ->  atom_concat(Pack, '/prolog', Folder),
       asserta(user:file_search_path(library, Folder))
   ;   true
   ).
:- use_module('../support/things/crowd').

main :-
    crowd_digest(Digest, Expected),
    format('things: ~d of ~d~n', [Digest, Expected]),
    Digest == Expected,
    halt(0).
