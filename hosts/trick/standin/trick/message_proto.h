/* Stand-in for Trick's header of this name: what the models of this folder use of it. */
#ifndef STANDIN_MESSAGE_PROTO_H
#define STANDIN_MESSAGE_PROTO_H

typedef enum { MSG_NORMAL = 0, MSG_INFO = 1, MSG_WARNING = 2, MSG_ERROR = 3, MSG_DEBUG = 10 } MESSAGE_TYPE;

#ifdef __cplusplus
extern "C" {
#endif

int message_publish(int level, const char *format, ...);

#ifdef __cplusplus
}
#endif
#endif
