// The errors that charts and list can show: each takes a row of the JSON and "object" or "frame", and gives the value, where
// small is good, and its standard error; undefined where the row has none.

const number = value => (typeof value === 'number' && Number.isFinite(value) ? value : undefined);
const pair = (value, error) => {
  const v = number(value);
  return v === undefined ? undefined : { value: v, error: number(error) };
};

export const metrics = [
  { key: 'flip', name: 'FLIP, mean', of: (row, area) => pair(row[area]?.flip?.mean, row[area]?.flip?.error) },
  { key: 'flip95', name: 'FLIP, 95th percentile', of: (row, area) => pair(row[area]?.flip?.p95) },
  { key: 'hdr', name: 'HDR-FLIP, mean', of: (row, area) => pair(row[area]?.hdr_flip?.mean, row[area]?.hdr_flip?.error) },
  { key: 'rmse', name: 'RMSE', of: (row, area) => pair(row[area]?.rmse?.value, row[area]?.rmse?.error) },
  { key: 'ssim', name: '1 − SSIM', of: (row, area) => pair(1 - row[area]?.ssim?.value, row[area]?.ssim?.error) },
  { key: 'normals', name: 'angle of normals, degrees', of: row => pair(row.normals_deg?.mean) },
  { key: 'outline', name: 'silhouette, pixels', of: row => pair(row.silhouette_px?.mean) },
];

export const metric_of = key => metrics.find(m => m.key === key) ?? metrics[0];

/** Those that at least one row has. */
export const metrics_in = rows =>
  metrics.filter(m => rows.some(row => m.of(row, 'object') ?? m.of(row, 'frame')));

export const time_of = row => {
  const prepare = number(row.prepare_seconds), render = number(row.render_seconds);
  return prepare === undefined && render === undefined ? undefined : (prepare ?? 0) + (render ?? 0);
};
export const bytes_of = row => number(row.memory_bytes) ?? number(row.texture_bytes);
