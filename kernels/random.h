/* Random: counter-based random numbers, Philox4x32-10 (Salmon and others, SC11, 2011): the same key
 * and counter give the same words on every device, in any order. */
#ifndef RANDOM_H
#define RANDOM_H

#include "kernels/constants.h"
#include "kernels/dialect.h"

#define RANDOM_ROUNDS 10

/* Second words of keys whose first is a seed: what the numbers are for. Detectors take their band. */
#define RANDOM_PIXEL 0xffff0000u
#define RANDOM_LOBE 0xffff0001u
#define RANDOM_HEMISPHERE 0xffff0002u

/* The upper word of a product, from halves of words: OpenCL C and C11 name it differently. */
static inline uint random_high(uint a, uint b)
{
    const uint low = (a & 0xffffu) * (b & 0xffffu);
    const uint first = (a >> 16) * (b & 0xffffu) + (low >> 16);
    const uint second = (a & 0xffffu) * (b >> 16) + (first & 0xffffu);

    return (a >> 16) * (b >> 16) + (first >> 16) + (second >> 16);
}

/* Replaces the four words of a counter by four random words.
 *   key   two words: who asks; counter: what for */
static inline void random_words(const uint *key, uint *counter)
{
    uint key0 = key[0], key1 = key[1];

    for (int i = 0; i < RANDOM_ROUNDS; i++) {
        const uint high0 = random_high(0xd2511f53u, counter[0]), low0 = 0xd2511f53u * counter[0];
        const uint high1 = random_high(0xcd9e8d57u, counter[2]), low1 = 0xcd9e8d57u * counter[2];
        counter[0] = high1 ^ counter[1] ^ key0;
        counter[1] = low1;
        counter[2] = high0 ^ counter[3] ^ key1;
        counter[3] = low0;
        key0 += 0x9e3779b9u;
        key1 += 0xbb67ae85u;
    }
}

/* Between 0 and 1, never either, every 2^-23. */
static inline float random_uniform(uint word)
{
    return ((float)(word >> 9) + 0.5f) * (1.0f / 8388608.0f);
}

/* Two independent normal numbers of variance 1 from two words (Box and Muller, 1958). */
static inline void random_normals(const uint *word, float *out)
{
    const float radius = sqrt(-2.0f * log(random_uniform(word[0])));
    const float angle = 2.0f * PI_F * random_uniform(word[1]);

    out[0] = radius * cos(angle);
    out[1] = radius * sin(angle);
}

#endif
