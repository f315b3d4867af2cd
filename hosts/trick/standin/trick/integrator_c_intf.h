/* Stand-in for Trick's header of this name: what the models of this folder use of it. */
#ifndef STANDIN_INTEGRATOR_C_INTF_H
#define STANDIN_INTEGRATOR_C_INTF_H

#ifdef __cplusplus
extern "C" {
#endif

int integrate(void);
double get_integ_time(void);
double get_integ_dt(void);
int get_intermediate_step(void);
void load_indexed_state(unsigned int index, double state);
void load_indexed_deriv(unsigned int index, double deriv);
double unload_indexed_state(unsigned int index);

#ifdef __cplusplus
}
#endif
#endif
