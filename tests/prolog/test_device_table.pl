:- use_module('../support/trees').

:- begin_tests(ev3_devices).
test(prints_each_device_with_what_it_reads, [forall(tree(Tree))]) :-
    with_tree(Tree, ( put_attribute(in1, value0, 843),
                      put_attribute(outB, position, 720),
                      put_attribute(outB, state, running),
                      with_output_to(string(Table), ev3_devices) )),
    forall(member(Row, [ ["in1", "lego-ev3-us", "US-DIST-CM", "84.3"],
                         ["in4", "lego-ev3-gyro", "GYRO-ANG", "0"],
                         ["outB", "lego-ev3-l-motor", "720", "running"] ]),
           assertion(row(Table, Row))).
test(lists_a_device_that_cannot_be_read, [forall(tree(Tree))]) :-
    with_tree(Tree, ( show_attribute(outB, position, nonsense),
                      with_output_to(string(Table), ev3_devices) )),
    assertion(row(Table, ["outB", "lego-ev3-l-motor", "attribute"])),
    assertion(row(Table, ["outC", "lego-ev3-l-motor"])).
test(says_that_there_is_nothing_and_where_it_looked, [forall(tree(Tree))]) :-
    with_tree(Tree, [],
              ( tree_root(Root),
                with_output_to(string(Text), ev3_devices) )),
    assertion(sub_string(Text, _, _, _, "Nothing")),
    assertion(sub_string(Text, _, _, _, Root)).
:- end_tests(ev3_devices).

% A line of the table holds all these words, the first one at its start.
row(Table, [First|Words]) :-
    split_string(Table, "\n", "", Lines),
    member(Line, Lines),
    sub_string(Line, 0, _, _, First),
    forall(member(Word, Words), sub_string(Line, _, _, _, Word)),
    !.
