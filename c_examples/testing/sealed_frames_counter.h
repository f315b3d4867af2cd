/* Counts what all threads of the program, those of the library among them, ask of the memory allocator and of the
 * system. The functions are replaced in the program itself, so the shared and the static library both get these. */
#ifndef SEALED_FRAMES_COUNTER_H
#define SEALED_FRAMES_COUNTER_H

/* malloc, calloc, realloc, posix_memalign, aligned_alloc, memalign, mmap, mremap and the like. */
unsigned long allocations(void);

/* free of what is not NULL, munmap. */
unsigned long frees(void);

#endif
