"""Random numbers, noise, counts and spread, against published words, closed forms and numpy."""
import numpy as np
import probe
import pytest
import records

COUNT = 1 << 18


def words(opencl, key, counter):
    """random_words of one counter, as 16-bit halves: a probe's numbers are float32."""
    body = (f"uint key[2] = {{{key[0]}u, {key[1]}u}}; uint word[4] = "
            f"{{{', '.join(f'{c}u' for c in counter)}}}; random_words(key, word);"
            "for (int k = 0; k < 4; k++) { out[2 * k] = word[k] >> 16; out[2 * k + 1] = word[k] & 0xffff; }")
    halves = probe.probe(opencl, "random.h", body, [[0.0]], outputs=8)[:, 0].astype(int)
    return [int(h) << 16 | int(l) for h, l in halves.reshape(4, 2)]


# Known answers of philox4x32-10, file kat_vectors of Random123 1.09 (Salmon and others)
@pytest.mark.parametrize("key, counter, expected", [
    ((0, 0), (0, 0, 0, 0), (0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8)),
    ((0xffffffff,) * 2, (0xffffffff,) * 4, (0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd)),
    ((0xa4093822, 0x299f31d0), (0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344),
     (0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1)),
])
def test_random_words_are_those_of_philox(opencl, key, counter, expected):
    assert tuple(words(opencl, key, counter)) == expected


def detect(opencl, radiance, **fields):
    """The kernel over detectors in rows of 512."""
    radiance = np.asarray(radiance, np.float32)
    record = np.zeros(1, records.DETECTOR)
    record["columns"], record["count"], record["gain"] = 512, len(radiance), 1
    for name, value in fields.items():
        record[name] = value
    out = np.empty_like(radiance)
    opencl.run("detector", (len(radiance),), record=record, radiance=radiance, out=out)
    return out.astype(float)


def test_without_a_part_the_radiance_goes_through_unchanged(opencl):
    radiance = np.linspace(0, 100, 1000, dtype=np.float32)

    assert (detect(opencl, radiance, seed=3) == radiance).all()


def test_noise_is_normal_with_its_standard_deviation(opencl):
    noise = detect(opencl, np.full(COUNT, 50.0), noise=2.0) - 50.0

    # five standard errors each: of a mean, a variance, a fraction
    assert abs(noise.mean()) < 5 * 2 / COUNT**.5
    assert noise.var() == pytest.approx(4, rel=5 * (2 / COUNT) ** .5)
    for edge, fraction in ((2.0, .6827), (4.0, .9545), (6.0, .9973)):
        found = np.mean(abs(noise) < edge)
        assert found == pytest.approx(fraction, abs=5 * (fraction * (1 - fraction) / COUNT) ** .5 + 5e-5)


def test_noise_of_neighbours_is_independent(opencl):
    noise = detect(opencl, np.zeros(COUNT), noise=1.0)

    for step in (1, 2, 512):
        assert abs(np.mean(noise[step:] * noise[:-step])) < 5 / COUNT**.5


@pytest.mark.parametrize("field", ["seed", "frame", "band"])
def test_another_key_draws_other_numbers(opencl, field):
    noise = [detect(opencl, np.zeros(COUNT), noise=1.0, **{field: k}) for k in (1, 2)]

    assert abs(np.mean(noise[0] * noise[1])) < 5 / COUNT**.5


def test_the_variance_of_shot_noise_goes_with_the_radiance(opencl):
    for radiance in (1.0, 10.0, 100.0):
        noise = detect(opencl, np.full(COUNT, radiance), shot=0.02, noise=0.3)
        expected = 0.09 + 0.02 * radiance
        assert noise.var() == pytest.approx(expected, rel=5 * (2 / COUNT) ** .5)


def test_a_fixed_pattern_is_the_same_in_every_frame(opencl):
    radiance = np.full(COUNT, 20.0)
    first, second = (detect(opencl, radiance, frame=k, fixed_gain=.01, fixed_offset=.5)
                     for k in (0, 7))

    assert (first == second).all()
    expected = (20 * .01) ** 2 + .5**2  # independent
    assert first.var() == pytest.approx(expected, rel=5 * (2 / COUNT) ** .5)


def test_a_periodic_wave_is_a_sine_of_the_place(opencl):
    got = detect(opencl, np.full(1 << 16, 10.0), periodic=.25, waves_across=.125, waves_down=.03)

    row, column = np.divmod(np.arange(1 << 16), 512)
    expected = 10 + .25 * np.sin(2 * np.pi * (column * .125 + row * np.float32(.03)))
    assert got == pytest.approx(expected, abs=2e-5)  # float32 of 64 waves


def test_counts_are_whole_and_the_nearest(opencl):
    radiance = np.linspace(-5, 45, 5001)
    got = detect(opencl, radiance, last_count=255, gain=8.0, offset=16.0)

    expected = np.clip(np.rint(np.float32(8) * np.float32(radiance) + 16), 0, 255)
    assert (got * 8 + 16 == expected).all()
    inside = (radiance > -2) & (radiance < 29.8)
    assert abs(got - radiance)[inside].max() <= .5 / 8 + 1e-5
    assert len(np.unique(got)) == 256


def blur(opencl, picture, weight, first_column, first_row, step=1):
    rows, columns = picture.shape
    record = np.zeros(1, records.BLUR)
    record["columns"], record["rows"], record["step"] = columns // step, rows // step, step
    record["picture_columns"], record["picture_rows"] = columns, rows
    record["weight_rows"], record["weight_columns"] = weight.shape
    record["first_column"] = np.int32(first_column).view(np.uint32)
    record["first_row"] = np.int32(first_row).view(np.uint32)
    out = np.empty((rows // step, columns // step), np.float32)
    opencl.run("blur", out.shape[::-1], record=record, weight=np.float32(weight),
               picture=np.float32(picture), out=out)
    return out


@pytest.mark.parametrize("shape, first, step", [((5, 7), (-3, -2), 1), ((4, 4), (0, 0), 4),
                                                ((8, 6), (-2, -3), 3)])
def test_the_spread_equals_double_precision(opencl, shape, first, step):
    random = np.random.default_rng(1994)
    picture, weight = random.uniform(0, 100, (37, 53)), random.uniform(0, 1, shape)
    weight /= weight.sum()

    got = blur(opencl, picture, weight, *first, step)

    wide = np.pad(picture, 16, mode="edge")  # beyond its edges the picture goes on as at them
    expected = np.zeros((37 // step, 53 // step))
    for k, i in np.ndindex(*shape):
        top, left = 16 + first[1] + k, 16 + first[0] + i
        expected += weight[k, i] * wide[top:top + 37 // step * step:step,
                                        left:left + 53 // step * step:step]
    assert got == pytest.approx(expected, rel=5e-6)  # sums of up to 48 float32
