// Messages of a run: events of an LCM log, of the record or as the server sends them, decoded by the layouts that come
// with the page (tools/view/page_settings.h).

interface Field {
  name: string;
  type: string;
  /// How many entries: a number, or the name of the field before that has it. None: a single one.
  count?: number | string;
  /// Of a message within the message.
  fields?: Field[];
}

export interface Layouts {
  format: number;
  version: string;
  channels: Record<string, { fingerprint: string; fields: Field[] }>;
  /// Names of the causes of sleep, by the number that TALUS_SLEEP has.
  causes: string[];
}

/// Of one channel, with its fields by name.
export interface Message {
  channel: string;
  /// Encoded.
  bytes: Uint8Array;
}

const headerSize = 28; // of an event in a log, before its channel's name
const fingerprintSize = 8;
const messageHeaderSize = fingerprintSize + 40;
const syncWord = 0xeda1da01;

const crcTable = Uint32Array.from({ length: 256 }, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; ++bit) value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1;
  return value;
});

/// CRC-32 as in zlib.
function checksum(bytes: Uint8Array): number {
  let value = 0xffffffff;
  for (let i = 0; i < bytes.length; ++i) value = crcTable[(value ^ bytes[i]) & 0xff] ^ (value >>> 8);
  return ~value >>> 0;
}

const viewOf = (bytes: Uint8Array): DataView => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

/// Takes the messages of a run out of a log. What is no valid event is left out byte by byte, as LogReader of
/// lcmtypes/log_reader.h does.
export class LogReader {
  /// Bytes left out so far.
  damage = 0;
  private at = 0;
  private readonly view: DataView;

  constructor(
    private readonly bytes: Uint8Array,
    private readonly layouts: Layouts,
  ) {
    this.view = viewOf(bytes);
  }

  /// The next message of a run; null at the end.
  next(): Message | null {
    while (this.at < this.bytes.length) {
      const size = this.eventSize();
      if (size === 0) {
        ++this.damage;
        ++this.at;
        continue;
      }
      const begin = this.at + headerSize;
      const channel = this.channel();
      this.at += size;
      if (channel in this.layouts.channels) return { channel, bytes: this.bytes.subarray(begin + channel.length, this.at) };
    }
    return null;
  }

  private channel(): string {
    const begin = this.at + headerSize;
    return String.fromCharCode(...this.bytes.subarray(begin, begin + this.view.getUint32(this.at + 20)));
  }

  /// Size of the valid event that begins here, or 0.
  private eventSize(): number {
    const { at, view, bytes } = this;
    if (at + headerSize > bytes.length || view.getUint32(at) !== syncWord) return 0;
    const nameLength = view.getUint32(at + 20);
    const end = at + headerSize + nameLength + view.getUint32(at + 24);
    if (nameLength === 0 || nameLength > 63 || end > bytes.length) return 0;
    if (this.channel() in this.layouts.channels) {
      const data = bytes.subarray(at + headerSize + nameLength, end);
      const holds = data.length >= messageHeaderSize + 4 && checksum(data.subarray(0, -4)) === view.getUint32(end - 4);
      return holds ? end - at : 0;
    }
    return end === bytes.length || (end + 4 <= bytes.length && view.getUint32(end) === syncWord) ? end - at : 0;
  }
}

type Numbers = Uint8Array | Int8Array | Int16Array | Int32Array | Float32Array | Float64Array;

/// Of each type: the bytes of an entry, how one is read, and a list of many.
const numberTypes: Record<string, { size: number; read: (view: DataView, at: number) => number; list: (length: number) => Numbers }> = {
  boolean: { size: 1, read: (view, at) => view.getUint8(at), list: (length) => new Uint8Array(length) },
  int8_t: { size: 1, read: (view, at) => view.getInt8(at), list: (length) => new Int8Array(length) },
  int16_t: { size: 2, read: (view, at) => view.getInt16(at), list: (length) => new Int16Array(length) },
  int32_t: { size: 4, read: (view, at) => view.getInt32(at), list: (length) => new Int32Array(length) },
  int64_t: { size: 8, read: (view, at) => Number(view.getBigInt64(at)), list: (length) => new Float64Array(length) },
  float: { size: 4, read: (view, at) => view.getFloat32(at), list: (length) => new Float32Array(length) },
  double: { size: 8, read: (view, at) => view.getFloat64(at), list: (length) => new Float64Array(length) },
};

class FieldReader {
  at = fingerprintSize;
  private readonly view: DataView;

  constructor(private readonly bytes: Uint8Array) {
    this.view = viewOf(bytes);
  }

  fields(all: Field[]): Record<string, unknown> {
    const message: Record<string, unknown> = {};
    for (const field of all) {
      const count = typeof field.count === "string" ? (message[field.count] as number) : field.count;
      message[field.name] = count === undefined ? this.entry(field) : this.list(field, count);
    }
    return message;
  }

  private entry({ type, fields }: Field): unknown {
    if (type === "string") return this.text();
    if (fields) return this.fields(fields);
    const { size, read } = numberTypes[type];
    this.at += size;
    return read(this.view, this.at - size);
  }

  private list(field: Field, count: number): unknown {
    if (count < 0 || count > this.bytes.length - this.at) throw new RangeError("counts do not match the size");
    const numbers = numberTypes[field.type];
    if (!numbers) return Array.from({ length: count }, () => this.entry(field));
    const list = numbers.list(count);
    for (let i = 0; i < count; ++i, this.at += numbers.size) list[i] = numbers.read(this.view, this.at);
    return list;
  }

  /// Its length with the final zero byte, then its bytes.
  text(): string {
    const length = this.view.getUint32(this.at);
    this.at += 4 + length;
    return new TextDecoder().decode(this.bytes.subarray(this.at - length, this.at - 1));
  }
}

/// The fields of a message; `lists` false: those before the first list. Throws where it is of another version than the
/// layouts.
export function decode<Fields>({ channel, bytes }: Message, { channels, format, version }: Layouts, lists = true): Fields {
  const { fingerprint, fields } = channels[channel];
  const own = viewOf(bytes).getBigUint64(0).toString(16).padStart(16, "0");
  const reader = new FieldReader(bytes);
  const wanted = lists ? fields : fields.slice(0, fields.findIndex(({ count }) => typeof count === "string"));
  if (own === fingerprint) return reader.fields(wanted) as Fields;
  // Format and version stand first in TALUS_RUN of every version.
  reader.at = messageHeaderSize + 4;
  const other = channel === "TALUS_RUN" ? `format ${viewOf(bytes).getInt32(messageHeaderSize)} of talus ${reader.text()}` : `a message on ${channel} of another version`;
  throw new Error(`${other}; this page reads format ${format} of talus ${version}`);
}
