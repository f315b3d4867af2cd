/* Stand-in for Trick's header of this name: what the models of this folder use of it. */
#ifndef STANDIN_REGULA_FALSI_H
#define STANDIN_REGULA_FALSI_H

#define BIG_TGO 1000.0

typedef enum { Decreasing = -1, Any, Increasing } Regula_Falsi;

typedef struct REGULA_FALSI {
    int lower_set;     /* (--) 1 once the error was below zero */
    int upper_set;     /* (--) 1 once the error was above zero */
    double x_lower;    /* (--) Error there */
    double t_lower;    /* (s)  Time there */
    double x_upper;    /* (--) Error there */
    double t_upper;    /* (s)  Time there */
    double error;      /* (--) Given by the caller: the function whose root is sought */
    double error_tol;  /* (--) Error that counts as zero */
    Regula_Falsi mode; /* (--) Which sense of the crossing counts */
} REGULA_FALSI;

#ifdef __cplusplus
extern "C" {
#endif

double regula_falsi(double now, REGULA_FALSI *search);
void reset_regula_falsi(double now, REGULA_FALSI *search);

#ifdef __cplusplus
}
#endif
#endif
