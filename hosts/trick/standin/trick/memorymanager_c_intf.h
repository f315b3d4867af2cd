/* Stand-in for Trick's header of this name: what the models of this folder use of it. */
#ifndef STANDIN_MEMORYMANAGER_C_INTF_H
#define STANDIN_MEMORYMANAGER_C_INTF_H

#ifdef __cplusplus
extern "C" {
#endif

void *TMM_declare_var_1d(const char *element, int count);
void TMM_delete_var_a(void *address);

#ifdef __cplusplus
}
#endif
#endif
