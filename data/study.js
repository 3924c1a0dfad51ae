// The charts of a page about studies, from the JSON in #study-data (study/study_page_frame.h).
(function () {
  'use strict';
  const shown = JSON.parse(document.getElementById('study-data').textContent);
  const box = document.querySelector('.plots');
  const blue = '#2b5fb8', green = '#0a6b4f', grey = '#5b6b7b';
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
  const canvas = height => {
    const div = document.createElement('div');
    if (height) div.style.height = height + 'px';
    const c = document.createElement('canvas');
    div.appendChild(c);
    box.appendChild(div);
    return c;
  };
  const axis = (text, extra) => Object.assign({title: {display: true, text: text}}, extra);
  const title = text => ({display: true, text: text});

  const histogram = h => {
    const counts = new Array(Math.ceil(Math.max(h.step, ...h.values) / h.step + 1e-9)).fill(0);
    for (const v of h.values) counts[Math.min(counts.length - 1, Math.floor(v / h.step))] += 1;
    return new Chart(canvas(), {
      type: 'bar',
      data: {labels: counts.map((_, i) => (i * h.step).toFixed(1)),
             datasets: [{data: counts, backgroundColor: blue, categoryPercentage: 1, barPercentage: 0.95}]},
      options: {plugins: {legend: {display: false}, title: title(h.title)},
                scales: {x: axis(h.axis), y: axis(h.of, {ticks: {precision: 0}})}}
    });
  };

  // A dot an operation, by size from the bottom up; below them the mean and its interval.
  const difference = d => {
    const dots = d.values.slice().sort((a, b) => a - b).map((v, i) => ({x: v, y: i + 1}));
    const below = -0.12 * dots.length - 0.5, top = dots.length + 1, bottom = 2 * below;
    const sets = [
      {label: 'an operation', data: dots, backgroundColor: blue + '99', pointRadius: 3},
      {label: 'mean', data: [{x: d.mean, y: below}], backgroundColor: green, pointStyle: 'rectRot', pointRadius: 8},
      {label: 'no difference', data: [{x: 0, y: bottom}, {x: 0, y: top}], showLine: true, pointRadius: 0,
       pointStyle: 'line', borderColor: grey, backgroundColor: grey, borderDash: [5, 4], borderWidth: 1}];
    if (d.low !== null) {
      sets.splice(2, 0, {label: '95 % interval', data: [{x: d.low, y: below}, {x: d.high, y: below}], showLine: true,
                         pointRadius: 0, pointStyle: 'line', borderColor: green, backgroundColor: green, borderWidth: 3});
    }
    return new Chart(canvas(), {
      type: 'scatter',
      data: {datasets: sets},
      options: {plugins: {title: title(d.title), legend: {position: 'bottom', labels: {usePointStyle: true}}},
                scales: {x: axis(d.axis),
                         y: {min: bottom, max: top, display: false}}}
    });
  };

  const whiskers = {
    id: 'whiskers',
    afterDatasetsDraw(chart, _, options) {
      const g = chart.ctx, x = chart.scales.x;
      g.save();
      g.strokeStyle = '#1c2733';
      g.beginPath();
      chart.getDatasetMeta(0).data.forEach((bar, i) => {
        const value = chart.data.datasets[0].data[i], sd = options.sds[i];
        const from = x.getPixelForValue(Math.max(0, value - sd)), to = x.getPixelForValue(value + sd);
        g.moveTo(from, bar.y); g.lineTo(to, bar.y);
        for (const end of [from, to]) { g.moveTo(end, bar.y - 3); g.lineTo(end, bar.y + 3); }
      });
      g.stroke();
      g.restore();
    }
  };
  const bars = b => new Chart(canvas(90 + 22 * b.names.length), {
    type: 'bar',
    plugins: [whiskers],
    data: {labels: b.names, datasets: [{data: b.values, backgroundColor: blue + '99'}]},
    options: {indexAxis: 'y',
              plugins: {legend: {display: false}, title: title(b.title), whiskers: {sds: b.sds}},
              scales: {x: axis(b.axis, {beginAtZero: true, suggestedMax: Math.max(...b.values.map((v, i) => v + b.sds[i]))}),
                       y: {ticks: {autoSkip: false}}}}
  });

  (shown.histograms || []).forEach(histogram);
  (shown.differences || []).forEach(difference);
  (shown.bars || []).forEach(bars);
})();
