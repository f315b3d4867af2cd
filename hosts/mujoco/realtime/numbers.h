/* Parameters of a sequence: `numbers.txt`, written by mechanisms/from_c.py, has rows of words. The first word
 * of a row is its name; several rows may have the same name. */
#ifndef NUMBERS_H
#define NUMBERS_H

enum { MOST_ROWS = 128, MOST_WORDS = 2048 };

typedef struct {
    char *text;
    char *words[MOST_WORDS];
    char **rows[MOST_ROWS];
    int sizes[MOST_ROWS], count;
} numbers;

/* Reads a file; these functions exit with 2 if something is missing. */
void read_numbers(numbers *n, const char *file);

/* Row of a name, the `which`-th from 0; NULL if there are fewer. */
char **row_of(const numbers *n, const char *name, int which);

/* A number of the only row of a name; number 0 follows the name. */
double number_at(const numbers *n, const char *name, int index);
double number(const numbers *n, const char *name);

#endif
