// A collision library in Go as a subject of Nearmiss, over pipes in binary; docs/reference/protocol.md explains each line.
//
//	go build -o balls docs/example-program/balls.go   &&   ./nearmiss run --command ./balls --subject balls-go
package main

import (
	"bufio"
	"encoding/binary"
	"math"
	"os"
)

const hello = `{"nearmiss": 3, "name": "balls-go", "version": "1.0", "scalar": "double", "batches": "binary", ` +
	`"offers": [{"query": "sphere_sphere_overlap"}, {"query": "moving_point_sphere", "gives": ["time", "location"]}]}` + "\n"

type vector [3]float64

func dot(a, b vector) float64      { return a[0]*b[0] + a[1]*b[1] + a[2]*b[2] }
func minus(a, b vector) vector     { return vector{a[0] - b[0], a[1] - b[1], a[2] - b[2]} }
func at(q []float64, i int) vector { return vector{q[i], q[i+1], q[i+2]} }

// An answer: whether it is yes, its values, and why there is none.
type answer struct {
	yes    bool
	values []float64
	cannot string
}

func ballsMeet(q []float64) answer {
	d, reach := minus(at(q, 0), at(q, 4)), q[3]+q[7]
	return answer{yes: dot(d, d) <= reach*reach}
}

// The outputs are time, location and normal; the hello says that the normal is not given.
func rayMeetsBall(q []float64) answer {
	v, w, radius := at(q, 3), minus(at(q, 0), at(q, 6)), q[9]
	a, b, c := dot(v, v), dot(w, v), dot(w, w)-radius*radius
	if c < 0 || a == 0 {
		return answer{cannot: "it starts inside, or does not move"}
	}
	if b >= 0 || b*b < a*c {
		return answer{values: make([]float64, 7)}
	}
	t := c / (math.Sqrt(b*b-a*c) - b)
	return answer{yes: true, values: []float64{t, q[0] + v[0]*t, q[1] + v[1]*t, q[2] + v[2]*t, 0, 0, 0}}
}

// The function of each offer, and a bit for each value that it gives.
var offers = []struct {
	answer func([]float64) answer
	given  uint64
}{{ballsMeet, 0}, {rayMeetsBall, 0b1111}}

type batch struct{ Offer, Count, First, Numbers uint32 }

type reply struct {
	Status, Yes uint8
	Reason      uint16
	Number      uint32
	Given       uint64
}

func must(err error) {
	if err != nil {
		panic(err)
	}
}

func main() {
	order := binary.LittleEndian // of the machines that Go's programs run on here
	cases, answers := bufio.NewReader(os.NewFile(3, "cases")), bufio.NewWriter(os.NewFile(4, "answers"))
	answers.WriteString(hello)
	must(answers.Flush())
	for b := (batch{}); binary.Read(cases, order, &b) == nil; {
		lengths, numbers := make([]uint32, b.Count), make([]float64, b.Numbers)
		must(binary.Read(cases, order, lengths))
		must(binary.Read(cases, order, numbers))
		for i, length := range lengths {
			offer := offers[b.Offer]
			a := offer.answer(numbers[:length])
			numbers = numbers[length:]
			r := reply{Reason: uint16(len(a.cannot)), Number: b.First + uint32(i), Given: offer.given}
			if a.yes {
				r.Yes = 1
			}
			if a.cannot != "" {
				r.Status = 1
			}
			must(binary.Write(answers, order, r))
			must(binary.Write(answers, order, a.values))
			answers.WriteString(a.cannot)
		}
		must(answers.Flush())
	}
}
