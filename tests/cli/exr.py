"""The header of a single-part OpenEXR file: attributes by name, and its channels. No library."""
import struct


def _text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def read_header(path):
    """Returns the attributes' bytes by name."""
    data = path.read_bytes()
    assert data[:4] == bytes([0x76, 0x2F, 0x31, 0x01])
    attributes, at = {}, 8
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes


def channels(attributes):
    """Names of the channels in the file's order; each is followed by 16 bytes of its own."""
    data, names, at = attributes["channels"], [], 0
    while data[at]:
        name, at = _text(data, at)
        names.append(name)
        at += 16
    return names
