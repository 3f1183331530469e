"use strict";
// Prints the content of an MCAP file as JSON, read by Foxglove's libraries. Byte arrays are printed
// as their SHA-256, except the first 12 bytes.
//   node mcap_dump.js FILE                     the whole file, from its beginning to its end
//   node mcap_dump.js FILE START END TOPIC     messages of a topic by the index; times in ns
const crypto = require("crypto");
const fs = require("fs");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const { ros2humble } = require("@foxglove/rosmsg-msgs-common");

const plain = (key, value) => {
  if (typeof value === "bigint") return value.toString();
  if (value instanceof Map) return Object.fromEntries(value);
  if (value instanceof Float64Array) return Array.from(value);
  if (value instanceof Uint8Array) {
    const sha256 = (bytes) => crypto.createHash("sha256").update(bytes).digest("hex");
    return { bytes: value.length, first: Array.from(value.subarray(0, 12)),
             sha256: sha256(value), sha256_behind_first: sha256(value.subarray(12)) };
  }
  return value;
};

// The definitions of ROS 2 Humble that a schema contains, each with the schema's own.
function definitionsIn(schema) {
  const fields = (all) => all.map((one) => [
    one.type.replace(/^(time|duration)$/, "builtin_interfaces/$1").toLowerCase(), one.name,
    one.isArray ?? false, one.arrayLength ?? null, one.isConstant ?? false,
    one.valueText ?? null, one.defaultValue ?? null]);
  return parse(new TextDecoder().decode(schema.data), { ros2: true }).map((one) => {
    const name = one.name ?? schema.name.replace("/msg/", "/");
    return { name, own: fields(one.definitions),
             official: ros2humble[name] ? fields(ros2humble[name].definitions) : null };
  });
}

class Decoder {
  schemas = new Map();
  channels = new Map();
  readers = new Map();
  decode(message) {
    const channel = this.channels.get(message.channelId);
    if (!this.readers.has(channel.schemaId)) {
      const text = new TextDecoder().decode(this.schemas.get(channel.schemaId).data);
      this.readers.set(channel.schemaId, new MessageReader(parse(text, { ros2: true })));
    }
    return { topic: channel.topic, log: message.logTime, publish: message.publishTime,
             sequence: message.sequence,
             message: this.readers.get(channel.schemaId).readMessage(message.data) };
  }
}

function readAll(file) {
  const reader = new McapStreamReader({ validateCrcs: true });
  const decoder = new Decoder();
  const all = { messages: [], attachments: [], others: [], definitions: [] };
  reader.append(fs.readFileSync(file));
  for (let record; (record = reader.nextRecord());) {
    if (record.type === "Schema" && !decoder.schemas.has(record.id)) {
      decoder.schemas.set(record.id, record);
      all.definitions.push(...definitionsIn(record));
    }
    if (record.type === "Channel") decoder.channels.set(record.id, record);
    if (record.type === "Message") all.messages.push(decoder.decode(record));
    else if (record.type === "Attachment") {
      all.attachments.push({ ...record, text: new TextDecoder().decode(record.data) });
    } else if (!["Schema", "Channel", "MessageIndex", "Chunk"].includes(record.type)) {
      all.others.push(record);
    }
  }
  if (!reader.done()) throw new Error("the file ends within a record");
  all.schemas = [...decoder.schemas.values()];
  all.channels = [...decoder.channels.values()];
  return all;
}

async function seek(file, start, end, topic) {
  const handle = fs.openSync(file);
  let bytes_read = 0;
  const readable = {
    size: async () => BigInt(fs.fstatSync(handle).size),
    read: async (offset, size) => {
      const bytes = new Uint8Array(Number(size));
      bytes_read += fs.readSync(handle, bytes, 0, bytes.length, Number(offset));
      return bytes;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable });
  const decoder = new Decoder();
  decoder.schemas = reader.schemasById;
  decoder.channels = reader.channelsById;
  const messages = [];
  for await (const message of reader.readMessages({ startTime: BigInt(start),
      endTime: BigInt(end), topics: [topic], validateCrcs: true })) {
    messages.push(decoder.decode(message));
  }
  return { messages, bytes_read };
}

const [file, ...range] = process.argv.slice(2);
(async () => (range.length === 0 ? readAll(file) : await seek(file, ...range)))().then(
  (result) => console.log(JSON.stringify(result, plain)),
  (error) => { console.error(error.message); process.exit(1); });
