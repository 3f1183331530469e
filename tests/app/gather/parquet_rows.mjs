// Prints the rows of a Parquet file as hyparquet reads them: binary values in base64, and the sizes of the row groups
// and the key-value metadata of the footer.
import {
    asyncBufferFromFile,
    parquetMetadataAsync,
    parquetReadObjects,
} from "../../readers/node_modules/hyparquet/src/node.js";

function plain(key, value) {
    if (typeof value === "bigint") return Number(value);
    if (value instanceof Uint8Array) return Buffer.from(value).toString("base64");
    return value;
}

const file = await asyncBufferFromFile(process.argv[2]);
const footer = await parquetMetadataAsync(file);
const rows = await parquetReadObjects({ file, utf8: false });
console.log(JSON.stringify({
    rows,
    row_groups: footer.row_groups.map(group => group.num_rows),
    metadata: Object.fromEntries(footer.key_value_metadata.map(({ key, value }) => [key, value])),
}, plain));
