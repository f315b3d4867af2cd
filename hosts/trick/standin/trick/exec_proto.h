/* Stand-in for Trick's header of this name: what the models of this folder use of it. */
#ifndef STANDIN_EXEC_PROTO_H
#define STANDIN_EXEC_PROTO_H

#ifdef __cplusplus
extern "C" {
#endif

int exec_terminate_with_return(int code, const char *file, int line, const char *message);

#ifdef __cplusplus
}
#endif
#endif
