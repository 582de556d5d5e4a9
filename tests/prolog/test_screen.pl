:- use_module('../support/dev', [bytes_of/2, dev_path/2, on_dev/2, put_bytes_of/3, with_dev/2]).
:- use_module('../support/pictures').
:- use_module('../support/trees').
:- use_module('../support/old_prolog').

:- meta_predicate
    on_screen(+, +, 0),
    with_picture(0, -),
    show(0).

%   Call Goal once with a screen of that depth, in bits, in a tree.
on_screen(plain, Bits, Goal) :-
    memberchk(Bits-Size, [32-91136, 1-3072]),
    with_dev([fb0-zero(Size)], Goal).
on_screen(simulator, Bits, Goal) :-
    with_sim(room, Goal, [screen(Bits)]).
on_screen(mount, 32, Goal) :-
    on_dev(mount, Goal).

screen(Tree, Bits) :-
    tree(Tree),
    member(Bits, [32, 1]),
    Tree-Bits \== mount-1.

%   The bytes of a PNG of what is on the screen after Goal.
with_picture(Goal, Bytes) :-
    tmp_file(picture, File),
    call(Goal),
    setup_call_cleanup(screen_png(File),
                       bytes_of(File, Bytes),
                       delete_file(File)).

show(Goal) :-
    screen_clear,
    call(Goal),
    screen_show.

:- begin_tests(pictures).
%   The same picture makes the same file, so that files can be compared.
test(are_as_they_were,
     [ forall(( screen(Tree, Bits), picture(Name) )),
       true(Drawn == Kept)
     ]) :-
    picture_file(Name, Bits, File),
    on_screen(Tree, Bits,
              ( with_picture(show(draw(Name)), Drawn),
                with_picture(show(screen_image(0, 0, File)), Kept) )).
test(differ_where_a_pixel_does, true(Drawn \== Other)) :-
    with_sim(room,
             ( with_picture(show(draw(face)), Drawn),
               with_picture(show(( draw(face), screen_point(0, 0) )), Other) )).
test(are_a_face_in_eight_lines) :-
    with_sim(room,
             ( with_picture(show(face), Drawn),
               with_picture(show(screen_image(0, 0, 'tests/pictures/face.png')),
                            Kept) )),
    Drawn == Kept.

face :-
    screen_clear,
    screen_circle(89, 64, 60, [width(3)]),
    forall(member(X, [65, 113]),
           screen_circle(X, 45, 8, [fill(true)])),
    screen_arc(89, 64, 36, 100, 160, [width(4)]),
    screen_show.
:- end_tests(pictures).

:- begin_tests(screen).
test(has_four_bytes_for_a_pixel, true([Corner, Second, Last] == [0, 85, 170])) :-
    on_screen(plain, 32,
              ( show(( screen_point(0, 0),
                       screen_point(1, 0, [color(dark_gray)]),
                       screen_point(177, 127, [color(light_gray)]) )),
                dev_path(fb0, File),
                bytes_of(File, Bytes) )),
    length(Bytes, 91136),
    Bytes = [Corner, Corner, Corner, 0, Second, Second, Second, 0,
             255, 255, 255, 0|_],
    append(_, [255, 255, 255, 0, Last, Last, Last, 0], Bytes),
    !.
test(has_a_bit_for_a_pixel_the_least_on_the_left, true(Line == Expected)) :-
    on_screen(plain, 1,
              ( show(( screen_point(0, 1), screen_point(9, 1),
                       screen_point(177, 1) )),
                dev_path(fb0, File),
                bytes_of(File, Bytes) )),
    length(Bytes, 3072),
    length(First, 24),
    maplist(=(0), First),
    append(First, After, Bytes),
    length(Line, 24),
    append(Line, _, After),
    % pixel 177 is bit 1 of byte 22
    numlist(0, 23, Numbers),
    maplist([N, B]>>( N == 0 -> B = 1 ; N == 1 -> B = 2 ; N == 22 -> B = 2 ; B = 0 ),
            Numbers, Expected),
    !.
test(shows_nothing_before_it_is_told, [forall(screen(Tree, Bits)), true(Before == After)]) :-
    on_screen(Tree, Bits,
              ( with_picture(show(true), Before),
                with_picture(screen_circle(50, 50, 20), After) )).
test(keeps_what_was_drawn, true(A == B)) :-
    with_sim(room,
             ( with_picture(show(( screen_point(1, 1), screen_point(2, 2) )), A),
               show(screen_point(1, 1)),
               with_picture(( screen_point(2, 2), screen_show ), B) )).
test(shows_what_others_drew, true(Bytes == Drawn)) :-
    % red, as this library never draws
    length(Red, 91136),
    red(Red),
    on_screen(plain, 32,
              ( dev_path(fb0, File),
                put_bytes_of(write, File, Red),
                with_picture(true, Bytes),
                Luma is 299 * 255 // 1000,
                grey(Luma, Grey),
                put_bytes_of(write, File, Grey),
                with_picture(true, Drawn) )).
test(of_an_other_size_is_none, [forall(member(Size, [0, 1, 3073, 8294400])), fail]) :-
    with_dev([fb0-zero(Size)], screen_show).
test(of_an_other_size_has_no_picture, fail) :-
    with_dev([fb0-zero(5)], screen_png('/no/such/file')).
test(may_be_missing, fail) :-
    with_dev([], screen_show).
test(may_be_missing_for_a_picture, fail) :-
    with_dev([], screen_png('/no/such/file')).
test(is_drawn_on_without_one) :-
    with_dev([], draw(shapes)).
test(cannot_be_written_to_a_missing_directory,
     error(existence_error(_, '/no/such/file'), _)) :-
    with_sim(room, screen_png('/no/such/file')).
test(takes_expressions, true(A == B)) :-
    with_sim(room,
             ( with_picture(show(screen_circle(40 + 9.7, 2 * 25, 10.2)), A),
               with_picture(show(screen_circle(50, 50, 10)), B) )).

red([]).
red([0, 0, 255, 0|Red]) :-
    red(Red).

grey(Luma, Bytes) :-
    length(Bytes, 91136),
    grey_pixels(Bytes, Luma).

grey_pixels([], _).
grey_pixels([L, L, L, 0|Rest], L) :-
    grey_pixels(Rest, L).
:- end_tests(screen).

:- begin_tests(screen_errors).
:- meta_predicate with_bytes(+, -, 0).

test(arguments_are_checked,
     [ forall(bad(Goal, Formal)),
       true(Thrown-(Before == After) =@= Formal-(Same == Same))
     ]) :-
    with_sim(room,
             ( with_picture(show(true), Before),
               catch(Goal, error(Thrown, _), true),
               screen_show,
               with_picture(true, After) )),
    Same = Before.

bad(screen_point(_, 1), instantiation_error).
bad(screen_point(a, 1), type_error(evaluable, a/0)).
bad(screen_point(1, 10001), domain_error(pixels, 10001)).
bad(screen_point(1, -10001), domain_error(pixels, -10001)).
bad(screen_point(1, 1, color), type_error(list, color)).
bad(screen_point(1, 1, [color(blue)]), domain_error(screen_color, blue)).
bad(screen_point(1, 1, [color(3)]), type_error(atom, 3)).
bad(screen_line(1, 1, 2, _), instantiation_error).
bad(screen_line(1, 1, 2, 2, [width(0)]), domain_error(line_width, 0)).
bad(screen_line(1, 1, 2, 2, [width(129)]), domain_error(line_width, 129)).
bad(screen_line(1, 1, 2, 2, [width(1.5)]), type_error(integer, 1.5)).
bad(screen_rectangle(1, 1, -1, 5), domain_error(pixels, -1)).
bad(screen_circle(1, 1, -1), domain_error(pixels, -1)).
bad(screen_arc(1, 1, -1, 0, 90), domain_error(pixels, -1)).
bad(screen_arc(1, 1, 10, 0, 100000), domain_error(degrees, 100000)).
bad(screen_arc(1, 1, 10, _, 90), instantiation_error).
bad(screen_text(1, 1, _), instantiation_error).
bad(screen_text(1, 1, f(x)), type_error(atomic, f(x))).
bad(screen_text(1, 1, a, [font(huge)]), domain_error(font, huge)).
bad(screen_text(1, 1, a, [scale(0)]), domain_error(text_scale, 0)).
bad(screen_text(1, 1, a, [scale(17)]), domain_error(text_scale, 17)).
bad(screen_text(1, 1, a, [align(up)]), domain_error(text_align, up)).
bad(screen_text(1, 1, a, [color(red)]), domain_error(screen_color, red)).
bad(screen_text(1, 1, a, [background(red)]), domain_error(screen_color, red)).
bad(screen_line(1, 1, 2, 2, [colour(black)]),
    domain_error(screen_option, colour(black))).
bad(screen_point(1, 1, [font(tiny)]), domain_error(screen_option, font(tiny))).
bad(screen_text(1, 1, a, [size(2)]), domain_error(screen_option, size(2))).
bad(screen_image(1, 1, _), instantiation_error).
bad(screen_image(_, 1, 'tests/pictures/sample.png'), instantiation_error).

test(a_fill_that_is_no_boolean, error(type_error(_, 7), _)) :-
    screen_rectangle(1, 1, 5, 5, [fill(7)]).
test(a_missing_image, error(existence_error(file, _), _)) :-
    screen_image(1, 1, 'tests/pictures/none.png').
test(an_image_that_is_none, error(syntax_error(png), _)) :-
    screen_image(1, 1, 'tests/prolog/test_screen.pl').
test(an_image_that_is_cut_short, error(syntax_error(png), _)) :-
    bytes_of('tests/pictures/sample.png', Bytes),
    length(Some, 300),
    append(Some, _, Bytes),
    !,
    with_bytes(Some, File, screen_image(1, 1, File)).
test(bitmaps_that_are_wrong,
     [ forall(member(Text, [ 'P1\n3 2\n1 0 1 0 0', 'P1\n3', 'P1\n0 2\n', 'P1\n9999 1\n0',
                             'P4\n9 2\nab', 'P5\n1 1\n255\na', 'P1\n2 1\n0 2', 'P'
                           ])),
       error(syntax_error(pbm), _)
     ]) :-
    with_file(Text, File, screen_image(1, 1, File)).
test(a_bitmap_without_blanks, true(A == B)) :-
    with_sim(room,
             ( with_file('P1 3 2 101#c\n010', File1,
                         with_picture(show(screen_image(4, 4, File1)), A)),
               with_file('P1\n3 2\n1 0 1\n0 1 0\n', File2,
                         with_picture(show(screen_image(4, 4, File2)), B)) )).

with_bytes(Bytes, File, Goal) :-
    tmp_file(bytes, File),
    setup_call_cleanup(put_bytes_of(write, File, Bytes),
                       once(Goal),
                       delete_file(File)).
:- end_tests(screen_errors).
