% Writes a site of HTML pages about the pack; run by `make doc`:
%
%   swipl -g main -t 'halt(1)' tools/doc.pl [DIRECTORY]
%
% DIRECTORY is doc by default. There is an index by task, one by predicate, a
% page for each library, and one each for worlds, robots and planners. The pages
% of libraries are pldoc's. All is in one folder, because pldoc's links between
% pages are names of files without a folder. It needs no network.

:- asserta(user:file_search_path(library, prolog)).

% The pages need no library that Rust would have to make: what it defines does nothing here.
:- dynamic ev3dev_library_file:loaded/0.
:- assertz(ev3dev_library_file:loaded).

native_does_nothing :-
    setup_call_cleanup(open('prolog/ev3dev/private/native/native.pl', read, In),
                       read_term(In, (:- module(Module, Exports)), []),
                       close(In)),
    forall(member(Name/Arity, Exports),
           ( functor(Head, Name, Arity),
             dynamic(Module:Name/Arity),
             assertz(Module:Head) )).

:- native_does_nothing.

:- use_module(library(pldoc)).
:- use_module(library(pldoc/doc_html), [doc_for_file/2]).
:- use_module(library(pldoc/doc_process), [doc_comment/4]).
:- use_module(library(pldoc/doc_wiki), [wiki_codes_to_dom/3]).
:- use_module(library(http/html_write)).
:- use_module(library(http/html_head), []).
:- use_module(library(apply)).
:- use_module(library(filesex)).
:- use_module(library(lists)).
:- use_module(library(readutil)).
:- use_module(library(uri), [uri_components/2, uri_data/3]).
:- use_module(library(xpath)).
:- use_module(library(sgml), [load_html/3]).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/planners)).
:- use_module(library(ev3dev/private/help/libraries), [pack_file/2]).

:- forall(pack_file('', File), use_module(File)).

% What one wants to do, and the libraries for it. Each public library is here.
task('Drive a robot with two wheels',
     [robot, drive, odometry, calibrate, jog]).
task('Let a robot react', [rules, layers, events, plnxt]).
task('Run motors',
     [motors, motor_settings, dc_motors, servo_motors, gripper]).
task('Ask sensors',
     [sensors, sensor_wait, infrared, nxt_sensors, sensor_info, colors, raw]).
task('Use the brick itself',
     [lights, buttons, sound, screen, console, battery, ports, time, compile]).
task('See what is connected', [device_table, driver, files]).
task('Ask why it did that', [journal, reasoning]).
task('Try it without a robot',
     [sim, sim_hand, sim_time, sim_views, sim_batch, sim_fenced]).
task('Teach', [exercise, random_worlds]).
task('Drive several robots', [bricks, worker]).
task('Look on', [view]).
task('Find a path', [grid, planners, roadmap, navigation]).
task('Find out where the robot is', [localize, map, grid_belief]).
task('Plan, act and react', [golog, golog_classic, pddl]).

main :-
    current_prolog_flag(argv, Argv),
    (   Argv = [Directory0|_]
    ->  true
    ;   Directory0 = doc
    ),
    absolute_file_name(Directory0, Directory),
    make_directory_path(Directory),
    must_have_a_task,
    findall(file(File, Page),
            ( documented_file(File), page(File, Page0),
              directory_file_path(Directory, Page0, Page) ),
            Map),
    maplist(write_library(Directory, Map), Map),
    write_index(Directory, Map),
    write_predicates(Directory, Map),
    write_worlds(Directory, Map),
    write_robots(Directory),
    write_planners(Directory, Map),
    copy_style(Directory),
    broken_links(Directory, Broken),
    (   Broken == []
    ->  length(Map, Count),
        format("~w: ~d libraries~n", [Directory0, Count]),
        halt(0)
    ;   forall(member(Page-Link, Broken),
               format(user_error, "~w: there is no ~w~n", [Page, Link])),
        halt(1)
    ).

must_have_a_task :-
    findall(Name,
            ( pack_file('', File), file_base_name(File, Base),
              file_name_extension(Name, pl, Base) ),
            Libraries),
    findall(Name, ( task(_, Names), member(Name, Names) ), Listed),
    subtract(Libraries, Listed, Missing),
    subtract(Listed, Libraries, Gone),
    (   Missing-Gone == []-[]
    ->  true
    ;   throw(error(existence_error(task, Missing-Gone),
                    context(task/2, 'libraries without a task, and tasks of none')))
    ).

% ---------------- LIBRARIES

public_file(File) :-
    member(Pattern, ['prolog/*.pl', 'prolog/ev3dev/*.pl']),
    expand_file_name(Pattern, Files),
    member(Relative, Files),
    absolute_file_name(Relative, File).

%   A public library, or a file that defines what one exports.

documented_file(File) :-
    findall(Def, ( export(_, _, Def) ; public_file(Def) ), Files),
    sort(Files, Sorted),
    member(File, Sorted).

%   A public library exports PI, which is defined and documented in Def.

export(File, PI, Def) :-
    public_file(File),
    module_property(Module, file(File)),
    module_property(Module, exports(Exports)),
    member(PI, Exports),
    defined_in(Module, PI, Def).

defined_in(Module, Name/Arity, Def) :-
    functor(Head, Name, Arity),
    (   predicate_property(Module:Head, imported_from(Origin))
    ->  true
    ;   Origin = Module
    ),
    module_property(Origin, file(Def)).

%   doc/motors.html, doc/planners_search.html

page(File, Page) :-
    absolute_file_name(prolog, Root),
    directory_file_path(Root, Relative, File),
    file_name_extension(Base, _, Relative),
    (   atom_concat('ev3dev/', Name0, Base)
    ->  true
    ;   Name0 = Base
    ),
    atomic_list_concat(Parts, /, Name0),
    atomic_list_concat(Parts, '_', Name),
    file_name_extension(Name, html, Page).

write_library(Directory, Map, file(File, Page)) :-
    with_options(Directory, Map, Options,
                 with_output_to(string(Html0),
                                ( b_setval(pldoc_output, Page),
                                  doc_for_file(File, Options) ))),
    also_exported(File, Map, Also),
    % A page's link to itself
    file_base_name(Page, Base),
    format(string(Self), "href=\"~w\"", [Base]),
    atomic_list_concat(Parts, 'href="."', Html0),
    atomic_list_concat(Parts, Self, Html1),
    without_undocumented(Html1, Also, Html),
    write_page(Page, Html).

%   pldoc makes links to other pages by these.

:- meta_predicate with_options(+, +, -, 0).

with_options(Directory, Map, Options, Goal) :-
    Options = [ files(Map), html_resources(pldoc_files), source_link(false),
                resource_directory(Directory), public_only(true) ],
    setup_call_cleanup(
        nb_setval(pldoc_options, Options),
        once(Goal),
        nb_delete(pldoc_options)).

%   pldoc takes what a library exports again for undocumented.

without_undocumented(Html0, Also, Html) :-
    once(sub_string(Html0, Body, _, _, "</body>")),
    (   sub_string(Html0, Before, _, _, "<h2 class=\"undoc\">")
    ->  true
    ;   Before = Body
    ),
    sub_string(Html0, 0, Before, _, Head0),
    sub_string(Html0, Body, _, 0, Tail),
    navigation(Navigation),
    (   sub_string(Head0, Start, _, _, "<body>")
    ->  End is Start + 6,
        sub_string(Head0, 0, End, _, Top),
        sub_string(Head0, End, _, 0, Rest)
    ),
    atomics_to_string([Top, Navigation, Rest, Also, Tail], Html).

navigation(String) :-
    to_string(p(\links), String).

links -->
    html([ a(href('index.html'), 'by task'), ' | ',
           a(href('predicates.html'), 'by predicate'), ' | ',
           a(href('worlds.html'), worlds), ' | ',
           a(href('robots.html'), robots), ' | ',
           a(href('planners_known.html'), planners) ]).

also_exported(File, Map, String) :-
    findall(PI-Def, ( export(File, PI, Def), Def \== File ), Pairs),
    sort(Pairs, Sorted),
    (   Sorted == []
    ->  String = ""
    ;   to_string([ h2('It exports, too'), p(\references(Sorted, Map)) ], String)
    ).

references([], _) --> [].
references([PI-File|More], Map) -->
    reference(PI, File, Map),
    html(' '),
    references(More, Map).

reference(PI, File, Map) -->
    { memberchk(file(File, Page), Map),
      file_base_name(Page, Base),
      format(atom(Text), '~w', [PI]),
      uri_data(path, Components, Base),
      uri_data(fragment, Components, Text),
      uri_components(Href, Components) },
    html(a(href(Href), Text)).

to_string(Html, String) :-
    phrase(html(Html), Tokens),
    with_output_to(string(String), print_html(Tokens)).

% ---------------- INDICES

write_index(Directory, Map) :-
    findall(Task-Names, task(Task, Names), Tasks),
    write_site_page(Directory, 'index.html', 'LEGO EV3 robots from Prolog',
                    [ p([ 'All of ', a(href('ev3dev.html'), 'library(ev3dev)'),
                          ' is there after ',
                          code('?- use_module(library(ev3dev)).'),
                          ' The other libraries are loaded by their names.' ]),
                      \tasks(Tasks, Map) ]).

tasks([], _) --> [].
tasks([Task-Names|Tasks], Map) -->
    html([ h2(Task), \libraries(Names, Map) ]),
    tasks(Tasks, Map).

libraries([], _) --> [].
libraries([Name|Names], Map) -->
    { absolute_file_name(library(ev3dev/Name), File,
                         [file_type(prolog), access(read)]),
      module_property(Module, file(File)),
      page(File, Page),
      title(Module, Title),
      findall(PI-Def,
              ( export(File, PI, Def), \+ elsewhere(Name, Def) ),
              Pairs),
      sort(Pairs, Sorted),
      format(atom(Library), 'library(ev3dev/~w)', [Name]),
      ( within(File) -> Where = '' ; Where = ' (loaded apart)' ) },
    html([ h3([ a(href(Page), Library), ': ', Title, Where ]),
           p(\references(Sorted, Map)) ]),
    libraries(Names, Map).

%   What a library shares with another one of the index is explained there.

elsewhere(Name, Def) :-
    file_base_name(Def, Base),
    file_name_extension(Other, pl, Base),
    Other \== Name,
    task(_, Names),
    memberchk(Other, Names).

within(File) :-
    module_property(Module, file(File)),
    module_property(Module, exports([PI|_])),
    module_property(ev3dev, exports(Exports)),
    memberchk(PI, Exports).

title(Module, Title) :-
    doc_comment(Module:module(Title), _, _, _),
    !.
title(Module, Module).

write_predicates(Directory, Map) :-
    findall(PI-(Def-Summary),
            ( export(_, PI, Def), summary(PI, Def, Summary) ), Pairs0),
    sort(Pairs0, Pairs),
    findall(tr([td(\reference(PI, Def, Map)), td(Summary)]),
            member(PI-(Def-Summary), Pairs), Rows),
    write_site_page(Directory, 'predicates.html', 'All predicates',
                    table(Rows)).

summary(PI, Def, Summary) :-
    module_property(Module, file(Def)),
    doc_comment(Module:PI, _, Summary, _),
    !.
summary(PI, Def, _) :-
    throw(error(existence_error(documentation, Def:PI), _)).

% ---------------- WORLDS, ROBOTS, PLANNERS

write_worlds(Directory, Map) :-
    fact_files(worlds, Files),
    forall(member(Name-_, Files), draw_world(Directory, Name)),
    markdown('docs/worlds.md', Text),
    with_options(Directory, Map, _,
                 write_site_page(Directory, 'worlds.html', 'Worlds',
                                 [ \wiki(Text),
                                   \shipped(Files, picture) ])).

wiki(Dom) -->
    pldoc_html:html(Dom).

%   As `make pictures` has drawn it

draw_world(Directory, Name) :-
    format(atom(Picture), 'docs/pictures/world_~w.svg', [Name]),
    copy_file(Picture, Directory).

write_robots(Directory) :-
    fact_files(robots, Files),
    write_site_page(Directory, 'robots.html', 'Robots',
                    [ p([ 'What a robot may hold is told ',
                          a(href('worlds.html'), 'with the worlds'), '.' ]),
                      \shipped(Files, text) ]).

fact_files(Kind, Files) :-
    format(atom(Pattern), 'prolog/ev3dev/~w/*.pl', [Kind]),
    expand_file_name(Pattern, Paths),
    findall(Name-Path,
            ( member(Path, Paths), file_base_name(Path, Base),
              file_name_extension(Name, _, Base) ),
            Files).

shipped([], _) --> [].
shipped([Name-File|Files], How) -->
    { read_file_to_string(File, Text, [encoding(utf8)]),
      format(atom(Picture), 'world_~w.svg', [Name]) },
    html(h2(Name)),
    (   { How == picture }
    ->  html(p(img([src(Picture), alt(Name), style('max-width: 24em')])))
    ;   []
    ),
    html(pre(class(code), Text)),
    shipped(Files, How).

write_planners(Directory, Map) :-
    findall(tr([td(code(Planner)), td(Claims)]),
            ( planner(Planner0), \+ \+ true,
              format(atom(Planner), '~p', [Planner0]),
              findall(C, ( planner_claim(Planner0, C) ), Cs0),
              sort(Cs0, Cs),
              maplist(in_words, Cs, Words),
              atomic_list_concat(Words, ', ', Claims) ),
            Rows0),
    list_to_set(Rows0, Rows),
    findall(PI-Def,
            ( absolute_file_name(library(ev3dev/planners), File,
                                 [file_type(prolog)]),
              export(File, PI, Def) ),
            Pairs),
    write_site_page(Directory, 'planners_known.html', 'Planners',
                    [ p([ 'Planners of ',
                          a(href('planners.html'), 'library(ev3dev/planners)'),
                          ', and what each promises of its plans:' ]),
                      table([tr([th(planner), th(promises)])|Rows]),
                      p(\references(Pairs, Map)) ]).

in_words(Claim, Words) :-
    format(atom(Text), '~p', [Claim]),
    atomic_list_concat(Parts, '_', Text),
    atomic_list_concat(Parts, ' ', Words).

% ---------------- PAGES

write_site_page(Directory, Name, Title, Html) :-
    phrase(page([ title(Title), meta(charset('UTF-8')),
                  link([rel(stylesheet), href('pldoc.css')]) ],
                [ p(\links), h1(class(file), Title), \html(Html) ]),
           Tokens),
    with_output_to(string(String), print_html(Tokens)),
    directory_file_path(Directory, Name, File),
    write_page(File, String).

write_page(File, Html) :-
    setup_call_cleanup(
        open(File, write, Out, [encoding(utf8)]),
        write(Out, Html),
        close(Out)).

markdown(File, Dom) :-
    read_file_to_string(File, Text, [encoding(utf8)]),
    % The page has a title of its own.
    once(sub_string(Text, 0, _, After, "# ")),
    sub_string(Text, _, After, 0, Rest0),
    once(sub_string(Rest0, _, _, Left, "\n")),
    sub_string(Rest0, _, Left, 0, Rest),
    string_codes(Rest, Codes),
    wiki_codes_to_dom(Codes, [], Dom).

copy_style(Directory) :-
    forall(member(Name, ['pldoc.css', 'h1-bg.png', 'h2-bg.png',
                         'multi-bg.png', 'priv-bg.png', 'pub-bg.png']),
           ( absolute_file_name(pldoc(Name), File, [access(read)]),
             copy_file(File, Directory) )).

%   Links to files of the site that are not there.

broken_links(Directory, Broken) :-
    format(atom(Pattern), '~w/*.html', [Directory]),
    expand_file_name(Pattern, Pages),
    findall(Name-Link,
            ( member(Page, Pages),
              load_html(Page, Dom, [syntax_errors(quiet)]),
              ( xpath(Dom, //a(@href), Link) ; xpath(Dom, //img(@src), Link) ),
              uri_components(Link, Components),
              uri_data(scheme, Components, Scheme), var(Scheme),
              uri_data(path, Components, Path),
              Path \== '', \+ var(Path),
              directory_file_path(Directory, Path, Target),
              \+ exists_file(Target),
              file_base_name(Page, Name) ),
            Broken0),
    sort(Broken0, Broken).
