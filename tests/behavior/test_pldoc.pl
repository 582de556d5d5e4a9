% pldoc makes a page of each public library, without a complaint; `make doc` makes
% a site without broken links.

:- asserta(user:file_search_path(library, prolog)).

:- if(( current_prolog_flag(version, Version), Version >= 80200,
        exists_source(library(pldoc)), exists_source(library(http/html_head)) )).

:- use_module(library(pldoc)).
:- use_module(library(pldoc/doc_html), [doc_for_file/2]).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/planners)).
:- use_module(library(ev3dev/roadmap)).

:- dynamic complaint/1.

:- begin_tests(pldoc).
test(makes_a_page_of_each_library,
     [ forall(library_file(File)), true(Complaints-Closed == []-true) ]) :-
    setup_call_cleanup(
        asserta((user:message_hook(Term, Kind, _) :-
                     memberchk(Kind, [warning, error]),
                     assertz(user:complaint(Term))), Hook),
        with_output_to(string(Page), doc_for_file(File, [])),
        erase(Hook)),
    findall(Term, retract(user:complaint(Term)), Complaints),
    (   sub_string(Page, _, _, _, "</html>")
    ->  Closed = true
    ;   Closed = false
    ).

% The binary pack has no tools.
test(the_site_has_no_broken_links,
     [condition(exists_file('tools/doc.pl')), true(Status == exit(0))]) :-
    tmp_file(doc, Directory),
    current_prolog_flag(executable, Prolog),
    setup_call_cleanup(
        process_create(Prolog, [ '-g', main, '-t', 'halt(1)', 'tools/doc.pl',
                                 file(Directory) ],
                       [stdout(null), process(Id)]),
        process_wait(Id, Status),
        ignore(catch(delete_directory_and_contents(Directory), _, fail))).

library_file(File) :-
    member(Pattern, ['prolog/*.pl', 'prolog/ev3dev/*.pl',
                     'prolog/ev3dev/planners/*.pl']),
    expand_file_name(Pattern, Files),
    member(Relative, Files),
    absolute_file_name(Relative, File).
:- end_tests(pldoc).

:- else.

:- begin_tests(pldoc).
test(is_installed, [blocked('library(pldoc) or HTTP is not installed')]) :-
    true.
:- end_tests(pldoc).

:- endif.
