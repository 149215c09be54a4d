/* One function per file, in the order in which main runs them. */
#ifndef TESTS_H
#define TESTS_H

void test_layout(void);
void test_status(void);
void test_particle(void);
void test_query(void);
void test_surface(void);
void test_definition(void);
void test_pose(void);
void test_settings(void);
void test_area(void);
void test_closest(void);
void test_pair_state(void);
void test_flat(void);
void test_hostile(void);
void test_threads(void);
void test_batch(void);
void test_in_plane(void);
void test_patch(void);
void test_derivatives(void);
void test_builder(void);

#endif
