% Every query in the README succeeds, in the order in which they stand there.

:- use_module(simulation).
:- use_module(dev, [bytes_of/2]).
% They run in another directory.
:- working_directory(Home, Home),
   atom_concat(Home, prolog, Library),
   asserta(user:file_search_path(library, Library)).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(readutil)).

:- begin_tests(readme).

test(its_queries_succeed, true(Failed == [])) :-
    queries('README.md', Queries),
    length(Queries, Count),
    Count >= 8,
    with_sim(room,
             in_temporary_directory(
                 findall(Query,
                         ( member(Query, Queries),
                           \+ succeeds(Query)
                         ),
                         Failed))).
test(its_face_is_the_picture_beside_it, true(Drawn == Kept)) :-
    read_file_to_string('README.md', Text, []),
    sub_string(Text, Start, _, _, "face :-"),
    sub_string(Text, Start, _, 0, Rest),
    setup_call_cleanup(open_string(Rest, In), read(In, (face :- Face)), close(In)),
    !,
    with_sim(room,
             ( call(Face),
               picture(Drawn),
               screen_clear, screen_image(0, 0, 'tests/pictures/face.png'),
               screen_show,
               picture(Kept) )).
test(each_example_it_names_is_there, [forall(named_example(File))]) :-
    exists_file(File).

:- meta_predicate in_temporary_directory(0).

in_temporary_directory(Goal) :-
    working_directory(Here, Here),
    tmp_file(readme, Directory),
    make_directory(Directory),
    setup_call_cleanup(
        working_directory(_, Directory),
        once(Goal),
        ( working_directory(_, Here),
          delete_directory_and_contents(Directory) )).

succeeds(Query) :-
    term_string(Goal, Query),
    with_output_to(string(_), user:Goal).

%   Lines of the code blocks that ask something, less what follows them.

queries(File, Queries) :-
    read_file_to_string(File, Text, []),
    split_string(Text, "\n", "", Lines),
    findall(Query,
            ( member(Line, Lines),
              string_concat("?- ", Rest, Line),
              sub_string(Rest, Before, _, _, "."),
              End is Before + 1,
              sub_string(Rest, End, _, 0, After),
              normalize_space(string(Comment), After),
              ( Comment == "" ; sub_string(Comment, 0, _, _, "%") ),
              sub_string(Rest, 0, Before, _, Query)
            ),
            Queries).

picture(Bytes) :-
    tmp_file(picture, File),
    setup_call_cleanup(screen_png(File), bytes_of(File, Bytes), delete_file(File)).

named_example(File) :-
    read_file_to_string('README.md', Text, []),
    sub_string(Text, Start, _, _, "EXAMPLE="),
    From is Start + 8,
    sub_string(Text, From, _, 0, Rest),
    split_string(Rest, "` \n", "", [Name|_]),
    atomic_list_concat(['examples/', Name, '.pl'], File).

:- end_tests(readme).
