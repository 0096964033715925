/// @file bench.h
/// The commands of feather-bench. main.c finds a command in a table; each gets the arguments after its name and returns
/// the exit code.
#ifndef BENCH_BENCH_H
#define BENCH_BENCH_H

int bench_command_speed(int argc, char **argv);
int bench_command_queries(int argc, char **argv);
int bench_command_draw(int argc, char **argv);
int bench_command_state(int argc, char **argv);
int bench_command_history(int argc, char **argv);
int bench_command_many(int argc, char **argv);
int bench_command_record(int argc, char **argv);
int bench_command_replay(int argc, char **argv);
int bench_command_play(int argc, char **argv);
int bench_command_scenes(int argc, char **argv);
int bench_command_run(int argc, char **argv);
int bench_command_compare(int argc, char **argv);
int bench_command_tasks(int argc, char **argv);
int bench_command_worse(int argc, char **argv);
int bench_command_profile(int argc, char **argv);
int bench_command_scaling(int argc, char **argv);
int bench_command_table(int argc, char **argv);
int bench_command_peers(int argc, char **argv);
int bench_command_check(int argc, char **argv);
int bench_command_update(int argc, char **argv);
int bench_command_list(int argc, char **argv);
int bench_command_help(int argc, char **argv);

#endif
